"""Finished runs, their readings and findings as plain columns, many at a time, for external analysis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from station.records import LARGEST_ID, State
from station.store.kept_file import KeptFile

Columns = dict[str, tuple[object, ...]]
"""Columns by name, all of equal length."""
Table = Literal["runs", "readings", "findings", "run_of_each"]

UNFINISHED = (State.QUEUED, State.RUNNING, State.WAITING)
GROWING = ("calibrations", "readings", "results", "findings", "chain", "events", "audit", "happenings")
MIGRATIONS = "_sqlite_migrations"
"""Table in which the library records the applied steps."""

RUNS = {
    "id": "id",
    "uid": "uid",
    "robot_serial": "robot_serial",
    "robot_type": "robot_type",
    "kind": "kind",
    "plan": "plan",
    "operator": "operator",
    "work_order": "work_order",
    "state": "state",
    "verdict": "verdict",
    "outcome": "outcome",
    "reason_code": "reason_code",
    "reason": "reason",
    "created_at": "created_ms",
    "started_at": "started_ms",
    "ended_at": "ended_ms",
    "dtheta1_deg": "zero1_deg",
    "dtheta1_sd_deg": "zero1_sd_deg",
    "dtheta2_deg": "zero2_deg",
    "dtheta2_sd_deg": "zero2_sd_deg",
    "position_error_mm": "position_error_mm",
}
RUN_OF_EACH = {"run_id": "id", "run_uid": "uid", "robot_serial": "robot_serial", "created_at": "created_ms"}
"""Columns of the run in each of its readings and findings."""
READINGS = {
    "run_id": "calibration_id",
    "reading": "reading",
    "sequence": "walk",
    "t_s": "t_s",
    "theta1_deg": "theta1_deg",
    "theta2_deg": "theta2_deg",
    "approach1": "approach1",
    "approach2": "approach2",
    "scale_mm": "scale_mm",
    "position": "position",
    "temperature_c": "temperature_c",
    "payload_kg": "payload_kg",
    "mount": "mount",
}
FINDINGS = {
    "run_id": "calibration_id",
    "effect": "effect",
    "joint": "joint",
    "part": "part",
    "probability": "probability",
    "p_value": "p_value",
    "parameter": "parameter",
    "value": "value",
    "sd": "sd",
    "unit": "unit",
}
_SOURCES: dict[Table, tuple[dict[str, str], str, str]] = {
    "runs": (RUNS, "calibrations LEFT JOIN results ON calibration_id = id", "id"),
    "readings": (READINGS, "readings", "calibration_id, reading"),
    "findings": (FINDINGS, "findings", "calibration_id, finding, n"),
    "run_of_each": (RUN_OF_EACH, "calibrations", "id"),
}
"""Columns with the source of each, tables, and order, beginning with the number of the run."""


class Tables(KeptFile):
    """Ranges of run numbers, both ends included."""

    def finished_after(self, run: int, most: int) -> list[tuple[int, str]]:
        """Number and month of creation (UTC, "2026-11") of runs after `run`, up to the first unfinished."""
        marks = ", ".join("?" * len(UNFINISHED))
        rows = self._readers.all(
            "SELECT id, strftime('%Y-%m', created_ms / 1000, 'unixepoch') AS month FROM calibrations"
            " WHERE id > ? AND id < coalesce("
            f"(SELECT min(id) FROM calibrations WHERE state IN ({marks}) AND id > ?), {LARGEST_ID})"
            " ORDER BY id LIMIT ?",
            [run, *UNFINISHED, run, most],
        )
        return [(row["id"], row["month"]) for row in rows]

    def table(self, table: Table, first: int, last: int) -> Iterator[Columns]:
        """Rows of these runs, in batches: one for each run, reading, or parameter of a found effect.

        Times are in ms since 1970.
        """
        columns, tables, order = _SOURCES[table]
        shown = ", ".join(f"{source} AS {name}" for name, source in columns.items())
        run = order.split(",")[0]
        for found in self._readers.columns(
            f"SELECT {shown} FROM {tables} WHERE {run} BETWEEN ? AND ? ORDER BY {order}", [first, last]
        ):
            yield dict(zip(columns, found, strict=True))

    def counts(self) -> dict[str, int]:
        """Rows of every table that only grows, by its name."""
        found: dict[str, int] = {}
        for table in GROWING:
            row = self._readers.one(f"SELECT count(*) AS n FROM {table}")
            found[table] = 0 if row is None else int(row["n"])
        return found

    def schema_step(self) -> str:
        """The last step that brought the tables up to date."""
        row = self._readers.one(f"SELECT name FROM {MIGRATIONS} ORDER BY id DESC LIMIT 1")
        return "" if row is None else str(row["name"])
