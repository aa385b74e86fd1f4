"""`/station`: devices, interlocks, live values and the run under way."""

from __future__ import annotations

from fastapi import APIRouter

from station.records import StationView
from web.routes.parts import TheRuntime

router = APIRouter(tags=["station"])


@router.get("/station", response_model=StationView)
def read_station(runtime: TheRuntime) -> StationView:
    """The whole station at this moment."""
    return runtime.orchestrator.snapshot()
