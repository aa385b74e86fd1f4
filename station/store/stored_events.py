"""Events: noteworthy facts of a run, or of the station itself."""

from __future__ import annotations

import json
from datetime import datetime

from pydantic import JsonValue

from station.records import StoredEvent
from station.store.kept_file import KeptFile
from station.store.rows import compact, moment
from station.store.times import now_ms


class StoredEvents(KeptFile):
    """Rows that are only ever added."""

    def add_event(
        self, calibration_id: int | None, kind: str, data: dict[str, JsonValue] | None = None
    ) -> None:
        """Add a noteworthy fact: who aborted, a message of a device."""
        with self._writing() as db:
            db.execute(
                "INSERT INTO events (calibration_id, at_ms, kind, data) VALUES (?, ?, ?, ?)",
                [calibration_id, now_ms(), kind, compact(data) if data else None],
            )

    def latest_time(self) -> datetime | None:
        """The latest recorded time of any run or event; None before the first."""
        row = self._readers.one(
            "SELECT max(coalesce((SELECT max(created_ms) FROM calibrations), 0),"
            " coalesce((SELECT ended_ms FROM calibrations ORDER BY id DESC LIMIT 1), 0),"
            " coalesce((SELECT at_ms FROM events ORDER BY id DESC LIMIT 1), 0)) AS latest_ms"
        )
        return moment(row["latest_ms"] or None) if row is not None else None

    def events(self, calibration_id: int | None) -> list[StoredEvent]:
        """Events of one run, or of the station itself (None)."""
        rows = self._readers.all(
            "SELECT id, at_ms, kind, data FROM events WHERE calibration_id IS ? ORDER BY id", [calibration_id]
        )
        return [
            StoredEvent(
                id=row["id"],
                at=moment(row["at_ms"]),
                kind=row["kind"],
                data=json.loads(row["data"]) if row["data"] else {},
            )
            for row in rows
        ]
