"""A copy of a history, taken back to the moment before a run measured anything."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

_LATER = (
    "DELETE FROM chain WHERE run_id >= :run",
    "DELETE FROM readings WHERE calibration_id >= :run",
    "DELETE FROM findings WHERE calibration_id >= :run",
    "DELETE FROM results WHERE calibration_id >= :run",
    "DELETE FROM memories WHERE calibration_id >= :run",
    "DELETE FROM zero_writes WHERE run_id >= :run",
    "DELETE FROM wire_logs WHERE run_id >= :run",
    "DELETE FROM events WHERE calibration_id >= :run",
    "DELETE FROM idempotency_keys WHERE calibration_id >= :run",
    "DELETE FROM calibrations WHERE id > :run",
    # data that were cleared, or changed of the robot, since then
    "UPDATE memories SET cleared_ms = NULL, cleared_by = NULL"
    " WHERE cleared_ms >= (SELECT created_ms FROM calibrations WHERE id = :run)",
    "DELETE FROM robots WHERE serial = (SELECT robot_serial FROM calibrations WHERE id = :run)"
    " AND id > (SELECT robot_id FROM calibrations WHERE id = :run)",
    "UPDATE calibrations SET state = 'queued', verdict = NULL, outcome = NULL, reason = NULL,"
    " reason_code = NULL, reason_params = NULL, step = 0, steps = 0, started_ms = NULL, ended_ms = NULL"
    " WHERE id = :run",
)
_FOUND = (
    "SELECT state, verdict, outcome, reason, reason_code, reason_params FROM calibrations WHERE id = ?",
    "SELECT result, diagnosis FROM results WHERE calibration_id = ?",
)


def rewind(copy: Path, run: int) -> None:
    """Only on a copy: remove everything from this run on except the run itself, which is queued again."""
    with closing(sqlite3.connect(copy)) as db, db:
        for sql in _LATER:
            db.execute(sql, {"run": run})


def found(database: Path, run: int) -> tuple[list[tuple[object, ...]], list[tuple[object, ...]]]:
    """All readings of a run, its end and its result, as stored in the database."""
    with closing(sqlite3.connect(database)) as db:
        readings = db.execute(
            "SELECT * FROM readings WHERE calibration_id = ? ORDER BY reading", [run]
        ).fetchall()
        return readings, [row for sql in _FOUND for row in db.execute(sql, [run]).fetchall()]
