"""A backup of the history."""

from __future__ import annotations

from datetime import datetime

from station.records.record import Record


class BackupMade(Record):
    """One backup file."""

    file: str
    bytes: int
    made_at: datetime
