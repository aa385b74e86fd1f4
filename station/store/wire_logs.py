"""The wire logs of runs, and their retention."""

from __future__ import annotations

import zlib
from datetime import datetime

from station.errors import NotFound
from station.store.kept_file import KeptFile
from station.store.rows import millis
from station.store.times import now_ms


class WireLogs(KeptFile):
    """One zlib stream per run, in pieces; the last may be missing after a crash."""

    def add_wire(self, run: int, piece: bytes) -> None:
        """Add the next piece; an empty one is ignored."""
        if not piece:
            return
        with self._writing() as db:
            db.execute(
                "INSERT INTO wire_logs (run_id, n, piece)"
                " SELECT ?, coalesce(max(n), 0) + 1, ? FROM wire_logs WHERE run_id = ?",
                [run, piece, run],
            )

    def wire_log(self, run: int) -> list[str]:
        """Its lines, the header first.  :raises NotFound: no such run, or no log of it is stored."""
        rows = self._readers.all("SELECT piece FROM wire_logs WHERE run_id = ? ORDER BY n", [run])
        if not rows:
            raise NotFound(f"No wire log of run {run} is kept here.")
        return zlib.decompressobj().decompress(b"".join(row["piece"] for row in rows)).decode().splitlines()

    def wire_bytes(self, run: int) -> int:
        """Its size in the database; 0 without one."""
        row = self._readers.one(
            "SELECT coalesce(sum(length(piece)), 0) AS bytes FROM wire_logs WHERE run_id = ?", [run]
        )
        return int(row["bytes"]) if row is not None else 0

    def drop_wire(self, ended_before: datetime) -> int:
        """Delete the logs of runs that ended before; returns their number. Each deletion is an event."""
        rows = self._readers.all(
            "SELECT DISTINCT run_id FROM wire_logs JOIN calibrations ON id = run_id WHERE ended_ms < ?",
            [millis(ended_before)],
        )
        for row in rows:
            with self._writing() as db:
                db.execute("DELETE FROM wire_logs WHERE run_id = ?", [row["run_id"]])
                db.execute(
                    "INSERT INTO events (calibration_id, at_ms, kind) VALUES (?, ?, 'wire_dropped')",
                    [row["run_id"], now_ms()],
                )
        return len(rows)
