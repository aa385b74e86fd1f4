"""`/station`: devices, interlocks, live values and the active run."""

from __future__ import annotations

from station.people import Permission
from station.records import StationView
from web.guarded import Router, needs
from web.routes.parts import TheAccess, TheRuntime

router = Router(tags=["station"])


@router.get("/station", response_model=StationView, dependencies=[needs(Permission.READ)])
def read_station(runtime: TheRuntime, access: TheAccess) -> StationView:
    """The complete current state of the station."""
    return runtime.orchestrator.snapshot().as_open(access.open)
