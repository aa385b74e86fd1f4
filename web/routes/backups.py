"""`/backups`: a copy of the history, made while the station works."""

from __future__ import annotations

from station.people import Permission
from station.records import BackupDrill, BackupMade, Record
from web.guarded import Router, needs
from web.routes.parts import TheRuntime

router = Router(prefix="/backups", tags=["backups"])


class BackupList(Record):
    """Backups, newest first."""

    items: list[BackupMade]
    next: None = None


@router.get("", response_model=BackupList, dependencies=[needs(Permission.READ)])
def list_backups(runtime: TheRuntime) -> BackupList:
    """The station's own backups in the folder of the station file."""
    return BackupList(items=runtime.backups())


@router.post("", status_code=201, response_model=BackupMade, dependencies=[needs(Permission.MAINTAIN)])
def back_up(runtime: TheRuntime) -> BackupMade:
    """Make a backup in the folder of the station file; `file` is its path on the station's computer."""
    return runtime.backup()


@router.post("/drill", status_code=201, response_model=BackupDrill, dependencies=[needs(Permission.MAINTAIN)])
def practise_restore(runtime: TheRuntime) -> BackupDrill:
    """Make a backup, open it beside the history, check its chains and compare the numbers of rows.

    The history is not touched.  The restore itself is `station restore`, with the service stopped.
    """
    return runtime.backup_drill()
