"""`/robots`: what is known of one robot, and forgetting it."""

from __future__ import annotations

from typing import Annotated

from station.people import Permission
from station.records import Actor
from web.bodies import Robot, Serial
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CallerName, TheRuntime

router = Router(prefix="/robots", tags=["robots"])


@router.get(
    "/{serial:path}", response_model=Robot, responses=documented(404), dependencies=[needs(Permission.READ)]
)
def read_robot(serial: Serial, runtime: TheRuntime) -> Robot:
    """Its file, and what its next run will know of geometry and mechanism."""
    memory = runtime.store.memory(serial)
    return Robot(
        serial=serial,
        file=runtime.store.robot(serial).to_json(),
        memory=memory.summary() if memory else None,
    )


@router.delete("/{serial:path}/memory", status_code=204, responses=documented(404))
def forget(
    serial: Serial,
    by: Annotated[Actor, needs(Permission.MAINTAIN)],
    runtime: TheRuntime,
    operator: CallerName = None,
) -> None:
    """The next run starts without memory; what was known stays on record.  Again is harmless."""
    runtime.store.forget(serial, by)
