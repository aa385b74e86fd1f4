"""`/healthz` and `/readyz`, for process supervision."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import JSONResponse

from station.records import StationView
from web.aside import aside
from web.bodies import Alive, Ready
from web.problems import documented, problem
from web.routes.parts import TheRuntime

LOOK_TIMEOUT_S = 8.0
"""Longer than a write waits for another program."""

router = APIRouter(tags=["health"])


@router.get("/healthz", response_model=Alive)
async def healthz() -> Alive:
    """200 as long as the process answers."""
    return Alive()


@router.get("/readyz", response_model=Ready, responses=documented(503))
async def readyz(runtime: TheRuntime) -> Ready | JSONResponse:
    """200 if a run could start; otherwise the missing conditions."""

    def look() -> list[str]:
        room = runtime.orchestrator.no_room()
        troubles = [*runtime.store.troubles(), *([room] if room else [])]
        return troubles + _missing(runtime.orchestrator.snapshot())

    try:
        missing = await aside(look, timeout_s=LOOK_TIMEOUT_S)
    except TimeoutError:
        missing = ["the station does not answer"]
    except Exception as error:  # noqa: BLE001 - whatever fails here is what is missing
        missing = [f"{type(error).__name__}: {error}"]
    if missing:
        return problem(503, "; ".join(missing), kind="not-ready", missing=missing)
    return Ready()


def _missing(snapshot: StationView) -> list[str]:
    devices = [f"{d.name}: {d.text or d.state}" for d in snapshot.devices if d.state in ("lost", "fault")]
    return devices + [f"interlock: {i.text}" for i in snapshot.interlocks if not i.ok]
