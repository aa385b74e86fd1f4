"""What is kept: one SQLite file; every reading is on the disk before the next move.

One writer behind a lock, WAL and synchronous=FULL; readers have connections of their own and never
wait for it.  Rows become records and dictionaries in `station.store.rows`.
"""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from threading import RLock
from typing import Any

from sqlite_utils import Database

from station.errors import InputRefused, KeyReused, NotFound
from station.five_bar import Robot
from station.records import CalibrationRequest, CalibrationResult, Reading, Remembered, State, ZeroWrite
from station.store.connections import Readers, open_writer
from station.store.rows import (
    LIST_COLUMNS,
    READING_COLUMNS,
    Page,
    calibration_dict,
    compact,
    document_from,
    millis,
    pack_document,
    pack_result,
    reading_from_row,
    reading_row,
    row_id,
    unsound,
    utc,
    zero_write_from_row,
)

_UNFINISHED = (State.QUEUED, State.RUNNING)


class Store:
    """Thread safe.  Calibration numbers rise with their creation time."""

    def __init__(self, path: Path) -> None:
        """Open or create the database and bring it up to date.

        :raises InputRefused: not a database, not the station's, or from a newer station.
        """
        self.path = path
        self._writer: Database = open_writer(path)
        self._lock = RLock()  # what is written in several steps, whole or not at all, takes it again
        self._readers = Readers(path)

    def close(self) -> None:
        """Release the file."""
        with self._lock:
            self._readers.close()
            self._writer.close()

    def backup(self, target: Path) -> None:
        """A copy of everything stored so far in one new file, made while the station works.

        :raises InputRefused: the file exists or cannot be written.
        """
        if target.exists():
            raise InputRefused(f"{target} exists already; a backup never overwrites.")
        self._readers.copy(target)

    @contextmanager
    def _writing(self) -> Iterator[Database]:
        with self._lock, self._writer.atomic():
            yield self._writer

    # Robots ------------------------------------------------------------------------------------

    def save_robot(self, robot: Robot) -> int:
        """Keep a robot file; a changed one becomes a new version.  Returns the version's row id."""
        file = compact(robot.to_json())
        with self._writing() as db:
            row = db.execute(
                "SELECT id, file FROM robots WHERE serial = ? ORDER BY id DESC LIMIT 1", [robot.serial]
            ).fetchone()
            if row is not None and row[1] == file:
                return int(row[0])
            cursor = db.execute(
                "INSERT INTO robots (serial, file, saved_ms) VALUES (?, ?, ?)",
                [robot.serial, file, _now()],
            )
            return int(cursor.lastrowid or 0)

    def robot(self, serial: str) -> Robot:
        """The latest version of a robot's file.  :raises NotFound:"""
        row = self._readers.one("SELECT file FROM robots WHERE serial = ? ORDER BY id DESC LIMIT 1", [serial])
        if row is None:
            raise NotFound(f"Robot {serial} is not known here.")
        return Robot.from_dict(json.loads(row["file"]), source=f"robot {serial}")

    def robot_or_nominal(self, serial: str) -> Robot:
        """The same, and the paper's Table 1 for a robot that no file is kept of."""
        try:
            return self.robot(serial)
        except NotFound:
            return Robot.default(serial)

    def robots(self) -> list[dict[str, Any]]:
        """The latest version of each: {serial, saved_at, file}."""
        rows = self._readers.all(
            "SELECT serial, file, saved_ms FROM robots"
            " WHERE id IN (SELECT max(id) FROM robots GROUP BY serial) ORDER BY serial"
        )
        return [
            {"serial": row["serial"], "saved_at": utc(row["saved_ms"]), "file": json.loads(row["file"])}
            for row in rows
        ]

    def robot_of(self, calibration_id: int) -> Robot:
        """The robot file as it was when the calibration was made.  :raises NotFound:"""
        row = self._readers.one(
            "SELECT file FROM robots WHERE id = (SELECT robot_id FROM calibrations WHERE id = ?)",
            [calibration_id],
        )
        if row is None:
            raise NotFound(f"There is no calibration {calibration_id}.")
        return Robot.from_dict(json.loads(row["file"]), source=f"robot of calibration {calibration_id}")

    # Memories ----------------------------------------------------------------------------------

    def memory(self, serial: str) -> Remembered | None:
        """What the robot's next run may use: of its newest pass, not cleared, under the same robot file."""
        row = self._readers.one(
            "SELECT calibration_id, at_ms, memory, robot_id, cleared_ms FROM memories"
            " JOIN calibrations ON id = calibration_id WHERE memories.robot_serial = ?"
            " ORDER BY calibration_id DESC LIMIT 1",
            [serial],
        )
        latest = self._readers.one("SELECT max(id) AS id FROM robots WHERE serial = ?", [serial])
        if row is None or latest is None or row["cleared_ms"] is not None or row["robot_id"] != latest["id"]:
            return None
        return _remembered(row)

    def memory_left_by(self, calibration_id: int) -> Remembered:
        """What one run left to the next, cleared or not.  :raises NotFound:"""
        row = self._readers.one(
            "SELECT calibration_id, at_ms, memory FROM memories WHERE calibration_id = ?", [calibration_id]
        )
        if row is None:
            raise NotFound(f"Run {calibration_id} left no memory.")
        return _remembered(row)

    def forget(self, serial: str, who: str) -> None:
        """The robot's next run starts without memory; what was known stays on record.

        Again is harmless.  :raises NotFound: no such robot.
        """
        self.robot(serial)
        with self._writing() as db:
            db.execute(
                "UPDATE memories SET cleared_ms = ?, cleared_by = ?"
                " WHERE robot_serial = ? AND cleared_ms IS NULL",
                [_now(), who, serial],
            )

    # Calibrations ------------------------------------------------------------------------------

    def create(
        self,
        request: CalibrationRequest,
        robot: Robot,
        *,
        key: str | None = None,
        body_hash: bytes = b"",
    ) -> int:
        """A new calibration in state queued; its idempotency key is kept in the same transaction.

        :raises KeyReused: the key is taken (ask `find_key` first to answer a repeated request).
        """
        robot_id = self.save_robot(robot)
        with self._writing() as db:
            # A station's clock may be set back; times still rise with the numbers, so that a
            # period of time is a range of numbers.
            latest = db.execute("SELECT max(created_ms) FROM calibrations").fetchone()[0] or 0
            cursor = db.execute(
                "INSERT INTO calibrations (robot_id, robot_serial, plan, operator, work_order, metadata,"
                " of_id, state, created_ms) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                [
                    robot_id,
                    robot.serial,
                    request.plan,
                    request.operator,
                    request.work_order,
                    compact(request.metadata) if request.metadata else None,
                    request.of,
                    State.QUEUED,
                    max(_now(), latest),
                ],
            )
            calibration_id = int(cursor.lastrowid or 0)
            if key is not None:
                taken = db.execute(
                    "SELECT calibration_id FROM idempotency_keys WHERE key = ?", [key]
                ).fetchone()
                if taken is not None:
                    raise KeyReused(int(taken[0]))
                db.execute("INSERT INTO idempotency_keys VALUES (?, ?, ?)", [key, body_hash, calibration_id])
        return calibration_id

    def add_run(
        self,
        request: CalibrationRequest,
        robot: Robot,
        readings: Sequence[Reading],
        result: CalibrationResult,
        *,
        key: str | None = None,
        body_hash: bytes = b"",
    ) -> int:
        """A run that was measured elsewhere, whole or not at all.  :raises KeyReused: as `create`."""
        with self._writing():
            calibration_id = self.create(request, robot, key=key, body_hash=body_hash)
            self.set_state(calibration_id, State.RUNNING, steps=len(readings))
            self.add_readings(calibration_id, readings)
            self.finish(calibration_id, State.SUCCEEDED, result)
        return calibration_id

    def last_on_rig(self) -> dict[str, Any] | None:
        """Summary of the newest run that the rig made, None before the first."""
        row = self._readers.one(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id"
            " WHERE plan != 'dataset' ORDER BY id DESC LIMIT 1",
            [],
        )
        return None if row is None else calibration_dict(row, full=False)

    def find_key(self, key: str, body_hash: bytes) -> int | None:
        """The calibration that a key started, None when the key is new.

        :raises KeyReused: the key came with another request.
        """
        row = self._readers.one("SELECT body_hash, calibration_id FROM idempotency_keys WHERE key = ?", [key])
        if row is None:
            return None
        if row["body_hash"] != body_hash:
            raise KeyReused(row["calibration_id"])
        return int(row["calibration_id"])

    def set_state(self, calibration_id: int, state: State, *, steps: int | None = None) -> None:
        """Move a calibration that has not ended to queued or running; `steps` is how many are planned."""
        with self._writing() as db:
            db.execute(
                "UPDATE calibrations SET state = ?, steps = coalesce(?, steps),"
                " started_ms = coalesce(started_ms, ?) WHERE id = ? AND state IN (?, ?)",
                [state, steps, _now(), calibration_id, *_UNFINISHED],
            )

    def finish(
        self, calibration_id: int, state: State, result: CalibrationResult | None = None, reason: str = ""
    ) -> State:
        """End a calibration, once: the first end stands.  Returns the state that is now stored.

        It fails closed: a result with a number that is not finite, or one of a run that did not
        succeed, is never kept as a pass.  What a pass leaves to the next run is kept with it.
        """
        verdict: str | None = None
        if result is not None:
            reason = reason or result.reason
            verdict = result.verdict
            if bad := unsound(result):
                state, verdict = State.FAILED, "fail"
                reason = f"The result is not a number at {bad}; it cannot be trusted."
            elif state is not State.SUCCEEDED:
                verdict = None
        elif state is State.SUCCEEDED:
            state, reason = State.FAILED, reason or "The run ended without a result."
        with self._writing() as db:
            ended = db.execute(
                "UPDATE calibrations SET state = ?, verdict = ?, reason = ?, ended_ms = ?"
                " WHERE id = ? AND state IN (?, ?)",
                [state, verdict, reason or None, _now(), calibration_id, *_UNFINISHED],
            ).rowcount
            if ended and result is not None:
                db.execute(
                    "INSERT INTO results VALUES (?, ?, ?, ?, ?, ?, ?)",
                    [calibration_id, *pack_result(result), pack_document(result.diagnosis)],
                )
                if verdict == "pass" and result.lasting is not None:
                    db.execute(
                        "INSERT INTO memories (calibration_id, robot_serial, at_ms, memory)"
                        " SELECT id, robot_serial, ended_ms, ? FROM calibrations WHERE id = ?",
                        [compact(result.lasting), calibration_id],
                    )
        return state if ended else State(self.calibration(calibration_id)["state"])

    def interrupt_unfinished(self) -> list[int]:
        """At start-up: what was queued or running when the station went down is interrupted.  Returns ids."""
        rows = self._readers.all("SELECT id FROM calibrations WHERE state IN (?, ?)", list(_UNFINISHED))
        ids = [int(row["id"]) for row in rows]
        for calibration_id in ids:
            self.finish(
                calibration_id,
                State.INTERRUPTED,
                reason="The station stopped during this run; the readings up to then are kept.",
            )
        return ids

    def calibration(self, calibration_id: int) -> dict[str, Any]:
        """One calibration with everything about it.  :raises NotFound:"""
        row = self._readers.one(
            f"SELECT {LIST_COLUMNS}, metadata, rest FROM calibrations"
            " LEFT JOIN results ON calibration_id = id WHERE id = ?",
            [calibration_id],
        )
        if row is None:
            raise NotFound(f"There is no calibration {calibration_id}.")
        return calibration_dict(row, full=True)

    def diagnosis(self, calibration_id: int) -> dict[str, Any]:
        """The diagnosis document of a run.  :raises NotFound: no such run, or it has none."""
        row = self._readers.one(
            "SELECT diagnosis FROM results WHERE calibration_id = ? AND diagnosis IS NOT NULL",
            [calibration_id],
        )
        if row is None:
            self.summary(calibration_id)
            raise NotFound(f"Run {calibration_id} has no diagnosis.")
        return document_from(row["diagnosis"])

    def summary(self, calibration_id: int) -> dict[str, Any]:
        """One calibration as the list shows it.  :raises NotFound:"""
        row = self._readers.one(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id WHERE id = ?",
            [calibration_id],
        )
        if row is None:
            raise NotFound(f"There is no calibration {calibration_id}.")
        return calibration_dict(row, full=False)

    def calibrations(
        self,
        *,
        limit: int = 50,
        cursor: int | str | None = None,
        robot_serial: str | None = None,
        state: str | None = None,
        verdict: str | None = None,
        since: datetime | None = None,
        until: datetime | None = None,
    ) -> Page:
        """A page of summaries, newest first; `cursor` is the `next` of the page before.

        :param since: created then or later; a time without a zone is UTC.
        :param until: created before.
        :raises InputRefused: a cursor that is none.
        """
        conditions: list[str] = []
        values: list[Any] = []
        for column, wanted in (("robot_serial", robot_serial), ("verdict", verdict), ("state", state)):
            if wanted is not None:
                # Only the first, most selective one may choose the index: + takes the others out.
                conditions.append(f"{'+' if conditions else ''}{column} = ?")
                values.append(wanted)
        if cursor is not None:
            conditions.append("id < ?")
            values.append(row_id(cursor))
        if since is not None:
            conditions.append(
                "id >= (SELECT id FROM calibrations WHERE created_ms >= ? ORDER BY created_ms, id LIMIT 1)"
            )
            values.append(millis(since))
        if until is not None:
            conditions.append(
                "id <= (SELECT id FROM calibrations WHERE created_ms < ?"
                " ORDER BY created_ms DESC, id DESC LIMIT 1)"
            )
            values.append(millis(until))
        where = f" WHERE {' AND '.join(conditions)}" if conditions else ""
        rows = self._readers.all(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id{where}"
            " ORDER BY id DESC LIMIT ?",
            [*values, limit + 1],
        )
        items = [calibration_dict(row, full=False) for row in rows[:limit]]
        return Page(items, items[-1]["id"] if len(rows) > limit else None)

    def runs_of(self, calibration_id: int) -> list[dict[str, Any]]:
        """Summaries of the runs that applied or rolled back a calibration, oldest first."""
        rows = self._readers.all(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id"
            " WHERE of_id = ? ORDER BY id",
            [calibration_id],
        )
        return [calibration_dict(row, full=False) for row in rows]

    # Zeros of the drives -----------------------------------------------------------------------

    def begin_zero_write(self, run_id: int, joint: int, offset_deg: float, from_deg: float) -> int:
        """On the disk before the drive is told; its row id for `end_zero_write`."""
        with self._writing() as db:
            cursor = db.execute(
                "INSERT INTO zero_writes (run_id, joint, at_ms, offset_deg, from_deg) VALUES (?, ?, ?, ?, ?)",
                [run_id, joint, _now(), offset_deg, from_deg],
            )
            return int(cursor.lastrowid or 0)

    def end_zero_write(self, write_id: int, to_deg: float | None) -> None:
        """What the drive's feedback says afterwards; None: it did not take the zero."""
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

    # Readings and events -----------------------------------------------------------------------

    def add_reading(self, calibration_id: int, reading: Reading) -> None:
        """Committed and on the disk when this returns."""
        self.add_readings(calibration_id, [reading])

    def add_readings(self, calibration_id: int, readings: Sequence[Reading]) -> None:
        """Several in one transaction, as an import does."""
        marks = ", ".join("?" * 14)
        with self._writing() as db:
            db.conn.executemany(
                f"INSERT INTO readings (calibration_id, {READING_COLUMNS}) VALUES ({marks})",
                [(calibration_id, *reading_row(reading)) for reading in readings],
            )
            db.execute(
                "UPDATE calibrations SET step = step + ? WHERE id = ?", [len(readings), calibration_id]
            )

    def readings(self, calibration_id: int) -> list[Reading]:
        """In the order they were taken.  :raises NotFound: no such calibration."""
        rows = self._readers.all(
            f"SELECT {READING_COLUMNS} FROM readings WHERE calibration_id = ? ORDER BY reading",
            [calibration_id],
        )
        if not rows:
            self.calibration(calibration_id)
        return [reading_from_row(row) for row in rows]

    def add_event(self, calibration_id: int | None, kind: str, data: dict[str, Any] | None = None) -> None:
        """Something worth remembering: who aborted, what a device said."""
        with self._writing() as db:
            db.execute(
                "INSERT INTO events (calibration_id, at_ms, kind, data) VALUES (?, ?, ?, ?)",
                [calibration_id, _now(), kind, compact(data) if data else None],
            )

    def events(self, calibration_id: int | None) -> list[dict[str, Any]]:
        """Of one run, or of the station itself (None): {id, at, kind, data}."""
        rows = self._readers.all(
            "SELECT id, at_ms, kind, data FROM events WHERE calibration_id IS ? ORDER BY id", [calibration_id]
        )
        return [
            {
                "id": row["id"],
                "at": utc(row["at_ms"]),
                "kind": row["kind"],
                "data": json.loads(row["data"]) if row["data"] else {},
            }
            for row in rows
        ]


def _remembered(row: sqlite3.Row) -> Remembered:
    at = datetime.fromtimestamp(row["at_ms"] / 1000, UTC)
    return Remembered(row["calibration_id"], at, json.loads(row["memory"]))


def _now() -> int:
    return time.time_ns() // 1_000_000
