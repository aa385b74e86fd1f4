"""`/station`: devices, interlocks, live values and the run under way."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter

from web.bodies import Station
from web.routes.parts import TheRuntime

router = APIRouter(tags=["station"])


@router.get("/station", response_model=Station)
def read_station(runtime: TheRuntime) -> dict[str, Any]:
    """The whole station at this moment."""
    return runtime.orchestrator.snapshot()
