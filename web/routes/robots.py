"""`/robots`: what is known of one robot, and forgetting it."""

from __future__ import annotations

from fastapi import APIRouter

from station.records import CalibrationHolds
from web.bodies import ClearBody, Robot, Serial
from web.problems import documented
from web.routes.parts import CallerName, TheRuntime

router = APIRouter(prefix="/robots", tags=["robots"])


@router.get("/{serial:path}", response_model=Robot, responses=documented(404))
def read_robot(serial: Serial, runtime: TheRuntime) -> Robot:
    """Its file, and what its next run will know of geometry and mechanism."""
    memory = runtime.store.memory(serial)
    return Robot(
        serial=serial,
        file=runtime.store.robot(serial).to_json(),
        memory=memory.summary() if memory else None,
    )


@router.post("/{serial:path}/clear-check", response_model=CalibrationHolds, responses=documented(404, 409))
def clear_check(serial: Serial, body: ClearBody, runtime: TheRuntime) -> CalibrationHolds:
    """After a failed check an engineer lets calibrated work go on; who and why stay on record."""
    return runtime.orchestrator.clear_failed_check(serial, body.operator, body.reason)


@router.delete("/{serial:path}/memory", status_code=204, responses=documented(404))
def forget(serial: Serial, runtime: TheRuntime, operator: CallerName = None) -> None:
    """The next run starts without memory; what was known stays on record.  Again is harmless."""
    runtime.store.forget(serial, operator or "REST")
