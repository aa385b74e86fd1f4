"""A backup of the history, and whether it could replace the history."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from station.records.record import Record


class BackupMade(Record):
    """One backup file."""

    file: str
    bytes: int
    made_at: datetime


class CountedTable(Record):
    """Number of rows of one table in the backup, and in the history before and after it was made."""

    table: str
    before: int
    backup: int
    after: int


class BackupDrill(Record):
    """A backup that was opened beside the history and compared with it."""

    backup: BackupMade
    passed: bool
    trouble: str = Field(description="what is wrong with the backup; empty when it passed")
    tables: tuple[CountedTable, ...]
    chained_runs: int = Field(description="finished runs of the backup that are as they ended")
    head: str = Field(description="hash of the last of these; the history has it too")
    audit_entries: int
    seconds: float
    restore: str = Field(description="the command that puts it in the place of the history")
