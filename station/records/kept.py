"""Stored data beside runs: robot files and events."""

from __future__ import annotations

from datetime import datetime

from pydantic import JsonValue

from station.records.record import Record
from station.records.sections import Sections


class KeptRobot(Record):
    """The latest version of a robot file."""

    serial: str
    saved_at: datetime | None
    file: Sections
    """The sections of the robot file."""


class StoredEvent(Record):
    """A noteworthy event: who aborted, a message of a device."""

    id: int
    at: datetime | None
    kind: str
    data: dict[str, JsonValue]
