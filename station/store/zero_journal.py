"""The journal of zeros: every zero is on the disk before it is sent to its drive."""

from __future__ import annotations

from station.records import ZeroWrite
from station.store.kept_file import KeptFile
from station.store.rows import zero_write_from_row
from station.store.times import now_ms


class ZeroJournal(KeptFile):
    """All information on the zeros in the drives comes from these rows."""

    def begin_zero_write(self, run_id: int, joint: int, offset_deg: float, from_deg: float) -> int:
        """Written to the disk before the drive receives it; returns its row id for `end_zero_write`."""
        with self._writing() as db:
            cursor = db.execute(
                "INSERT INTO zero_writes (run_id, joint, at_ms, offset_deg, from_deg) VALUES (?, ?, ?, ?, ?)",
                [run_id, joint, now_ms(), offset_deg, from_deg],
            )
            return int(cursor.lastrowid or 0)

    def end_zero_write(self, write_id: int, to_deg: float | None) -> None:
        """The drive's feedback afterwards; None: it did not accept the zero."""
        with self._writing() as db:
            db.execute(
                "UPDATE zero_writes SET to_deg = ?, taken = ? WHERE id = ?",
                [to_deg, to_deg is not None, write_id],
            )

    def zero_writes(self, serial: str, *, since: int = 0) -> list[ZeroWrite]:
        """Zeros written to a robot's drives by runs later than `since`, in order."""
        rows = self._readers.all(
            "SELECT zero_writes.*, of_id FROM zero_writes JOIN calibrations ON calibrations.id = run_id"
            " WHERE robot_serial = ? AND run_id > ? ORDER BY zero_writes.id",
            [serial, since],
        )
        return [zero_write_from_row(row) for row in rows]
