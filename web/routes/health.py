"""`/healthz` and `/readyz`, for whoever supervises the process."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import JSONResponse

from station.records import StationView
from web.aside import aside
from web.bodies import Alive, Ready
from web.problems import documented, problem
from web.routes.parts import TheRuntime

SNAPSHOT_TIMEOUT_S = 2.0

router = APIRouter(tags=["health"])


@router.get("/healthz", response_model=Alive)
async def healthz() -> Alive:
    """200 as long as the process answers at all."""
    return Alive()


@router.get("/readyz", response_model=Ready, responses=documented(503))
async def readyz(runtime: TheRuntime) -> Ready | JSONResponse:
    """200 when a run could start; else what is missing."""

    def look() -> StationView:
        runtime.store.calibrations(limit=1)
        return runtime.orchestrator.snapshot()

    try:
        missing = _missing(await aside(look, timeout_s=SNAPSHOT_TIMEOUT_S))
    except TimeoutError:
        missing = ["the orchestrator does not answer"]
    except Exception as error:  # noqa: BLE001 - whatever fails here is what is missing
        missing = [f"{type(error).__name__}: {error}"]
    if missing:
        return problem(503, "; ".join(missing), kind="not-ready", missing=missing)
    return Ready()


def _missing(snapshot: StationView) -> list[str]:
    devices = [f"{d.name}: {d.text or d.state}" for d in snapshot.devices if d.state in ("lost", "fault")]
    return devices + [f"interlock: {i.text}" for i in snapshot.interlocks if not i.ok]
