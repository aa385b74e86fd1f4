"""`/backups`: a copy of the history, made while the station works."""

from __future__ import annotations

from station.people import Permission
from station.records import BackupMade
from web.guarded import Router, needs
from web.routes.parts import TheRuntime

router = Router(prefix="/backups", tags=["backups"])


@router.post("", status_code=201, response_model=BackupMade, dependencies=[needs(Permission.MAINTAIN)])
def back_up(runtime: TheRuntime) -> BackupMade:
    """Make one in the folder of the station file; `file` is its path on the station's computer."""
    return runtime.backup()
