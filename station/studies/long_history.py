"""A history made long: the runs of a small one again and again, later and later."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from itertools import islice
from pathlib import Path
from random import Random

from station.records import uid7

A_MINUTE_MS = 60_000
BATCH = 20_000
ROBOTS = 1000
_RUN = "calibrations"
_OF_RUN = {
    "results": "calibration_id",
    "findings": "calibration_id",
    "readings": "calibration_id",
    "made_by": "run_id",
}
"""Tables of what a run leaves, with the column that names it."""


def lengthen(database: Path, runs: int, *, readings: bool) -> None:
    """Copies of the finished runs that DATABASE holds, until there are as many, a minute after each other.

    :param readings: with their readings; a list of runs does not ask for them
    """
    with closing(sqlite3.connect(database)) as db:
        db.execute("PRAGMA synchronous = OFF")
        first = _one(db, f"SELECT max(id) FROM {_RUN}")
        whole = [
            row[0] for row in db.execute(f"SELECT id FROM {_RUN} WHERE ended_ms IS NOT NULL ORDER BY id")
        ]
        latest_ms = _one(db, f"SELECT max(ended_ms) FROM {_RUN}")
        rng = Random(1)
        numbers = iter(range(first + 1, runs + 1))
        db.execute(
            "CREATE TEMP TABLE copies"
            " (new INTEGER PRIMARY KEY, old INTEGER, uid TEXT, serial TEXT, later INTEGER)"
        )
        while batch := list(islice(numbers, BATCH)):
            with db:
                db.execute("DELETE FROM copies")
                db.executemany(
                    "INSERT INTO copies VALUES (?, ?, ?, ?, ?)",
                    (
                        (
                            k,
                            whole[(k - first - 1) % len(whole)],
                            uid7(),
                            f"R{rng.randint(1, ROBOTS)}",
                            (k - first) * A_MINUTE_MS,
                        )
                        for k in batch
                    ),
                )
                _copy(db, _RUN, "id", latest_ms)
                for table, column in _OF_RUN.items():
                    if readings or table != "readings":
                        _copy(db, table, column, latest_ms)


def _copy(db: sqlite3.Connection, table: str, key: str, latest_ms: int) -> None:
    """Every row of the batch's runs, under the new number; in the columns that say when, later."""
    new = {
        key: "copies.new",
        "uid": "copies.uid",
        "robot_serial": "copies.serial",
        "created_ms": f"{latest_ms} + copies.later",
        "started_ms": f"{latest_ms} + copies.later + started_ms - created_ms",
        "ended_ms": f"{latest_ms} + copies.later + ended_ms - created_ms",
    }
    columns = [row[1] for row in db.execute(f"PRAGMA table_info({table})")]
    shown = ", ".join(new.get(column, f"{table}.{column}") for column in columns)
    db.execute(
        f"INSERT INTO {table} SELECT {shown} FROM copies JOIN {table} ON {table}.{key} = copies.old"
        " ORDER BY copies.new"
    )


def _one(db: sqlite3.Connection, sql: str) -> int:
    return int(db.execute(sql).fetchone()[0])
