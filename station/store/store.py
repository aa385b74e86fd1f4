"""The store: one SQLite file; every reading is on the disk before the next motion.

One writer behind a lock, WAL and synchronous=FULL; readers have separate connections and never wait for it.
Rows become records in `station.store.rows`.
"""

from __future__ import annotations

import logging
import sqlite3
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import TypeVar

from station.errors import KeyReused, NotFound, StoreUnavailable
from station.records import (
    STATION,
    Actor,
    Calibration,
    CalibrationRequest,
    CalibrationResult,
    CalibrationSummary,
    DiagnosisDocument,
    ImportedLog,
    MadeBy,
    Reading,
    Reason,
    State,
    because,
    uid7,
)
from station.store.chain import Verified, append, verify
from station.store.ends import End, UnstoredEnds, end_of
from station.store.filters import FEW, MOST_COUNTED, Filters, Order, beyond, ordered, where
from station.store.logs import Logs
from station.store.outbox import Outbox
from station.store.people import People
from station.store.provenance import Provenance
from station.store.results import keep_result
from station.store.robots import Memories, RobotFile, type_of
from station.store.rows import (
    LIST_COLUMNS,
    READING_COLUMNS,
    Page,
    asked_more,
    calibration_from_row,
    compact,
    document_from,
    millis,
    reading_from_row,
    reading_row,
    reason_columns,
    row_id,
    summary_from_row,
)
from station.store.settings_in_use import SettingsInUse
from station.store.stored_events import StoredEvents
from station.store.tables import UNFINISHED, Tables
from station.store.times import RunTimes, now, now_ms
from station.store.trends import Trends
from station.store.wire_logs import WireLogs
from station.store.zero_journal import ZeroJournal

log = logging.getLogger(__name__)

S = TypeVar("S", bound=CalibrationSummary)
_DEEDS = {"apply": "run.applied", "rollback": "run.rolled_back"}
"""Audit actions for the start of a run, by kind."""


class Store(
    StoredEvents,
    Memories,
    ZeroJournal,
    WireLogs,
    Logs,
    Provenance,
    Trends,
    Tables,
    People,
    SettingsInUse,
    Outbox,
):
    """Thread safe.  Order is by number: the clock that gives the times may jump.

    Every method may raise `StoreUnavailable`, unless it says otherwise.
    """

    def __init__(self, path: Path, *, read_only: bool = False) -> None:
        super().__init__(path, read_only=read_only)
        self._unstored = UnstoredEnds(path)
        self._times = RunTimes()

    # Calibrations ------------------------------------------------------------------------------

    def create(
        self,
        request: CalibrationRequest,
        robot: RobotFile,
        *,
        key: str | None = None,
        body_hash: bytes = b"",
        uid: str | None = None,
        by: Actor = STATION,
        made_by: MadeBy | None = None,
    ) -> int:
        """A new calibration in state queued; its idempotency key is stored in the same transaction.

        :param uid: if it is known already; otherwise generated.
        :param by: the person who starts it, for the audit.
        :param made_by: software and devices, if this station measures it.
        :raises KeyReused: the key is in use (call `find_key` first to answer a repeated request).
        """
        robot_id = self.save_robot(robot)
        with self._writing() as db:
            created_ms = now_ms()
            cursor = db.execute(
                "INSERT INTO calibrations (robot_id, robot_serial, robot_type, kind, plan, operator,"
                " work_order, metadata, of_id, state, created_ms, uid)"
                " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                [
                    robot_id,
                    robot.serial,
                    type_of(robot.to_json()),
                    request.kind,
                    request.label,
                    request.operator,
                    request.work_order,
                    compact(request.metadata) if request.metadata else None,
                    request.of,
                    State.QUEUED,
                    created_ms,
                    uid or uid7(created_ms),
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
            db.execute("INSERT INTO run_starters VALUES (?, ?, ?)", [calibration_id, by.name, by.via])
            self.record(by, _DEEDS.get(request.kind, "run.started"), f"run {calibration_id}")
            self.announce_run("run.started", calibration_id)
            if made_by is not None:
                self.keep_made_by(calibration_id, made_by)
            if more := asked_more(request):
                self.add_event(calibration_id, "asked", more)
        self._times.begin(calibration_id, created_ms)
        return calibration_id

    def add_run(
        self,
        request: CalibrationRequest,
        robot: RobotFile,
        readings: Sequence[Reading],
        result: CalibrationResult,
        *,
        log: ImportedLog | None = None,
        key: str | None = None,
        body_hash: bytes = b"",
        by: Actor = STATION,
    ) -> int:
        """Store a run that was measured elsewhere, in one transaction.  :raises KeyReused: as `create`.

        :param log: in place of readings, for another kind of machine.
        """
        with self._writing():
            calibration_id = self.create(request, robot, key=key, body_hash=body_hash, by=by)
            self.set_state(calibration_id, State.RUNNING, steps=len(readings))
            self.add_readings(calibration_id, readings)
            if log is not None:
                self.keep_log(calibration_id, log)
            self._end(calibration_id, end_of(State.SUCCEEDED, result, None, self._times.now(calibration_id)))
        return calibration_id

    def last_on_rig(self) -> CalibrationSummary | None:
        """Summary of the newest run that the rig made, None before the first."""
        row = self._readers.one(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id"
            " WHERE kind != 'import' ORDER BY id DESC LIMIT 1",
            [],
        )
        return None if row is None else self._as_ended(summary_from_row(row))

    def find_key(self, key: str, body_hash: bytes) -> int | None:
        """The calibration that a key started, None if the key is new.

        :raises KeyReused: the key was used for another request.
        """
        row = self._readers.one("SELECT body_hash, calibration_id FROM idempotency_keys WHERE key = ?", [key])
        if row is None:
            return None
        if row["body_hash"] != body_hash:
            raise KeyReused(row["calibration_id"])
        return int(row["calibration_id"])

    def set_state(self, calibration_id: int, state: State, *, steps: int | None = None) -> None:
        """Move a calibration that has not ended to queued or running; `steps` is the planned number."""
        with self._writing() as db:
            db.execute(
                "UPDATE calibrations SET state = ?, steps = coalesce(?, steps),"
                " started_ms = coalesce(started_ms, ?) WHERE id = ? AND state IN (?, ?, ?)",
                [state, steps, self._times.now_ms(calibration_id), calibration_id, *UNFINISHED],
            )

    def finish(
        self,
        calibration_id: int,
        state: State,
        result: CalibrationResult | None = None,
        reason: Reason | None = None,
        *,
        judged: bool = True,
    ) -> State:
        """End a calibration; only the first end counts. Returns its state.

        In case of doubt it is a failure (`end_of`). The data that a pass leaves to the next run are stored
        with it. An end that the store does not accept is shown from memory, as a failure, until `repeat_ends`
        has stored it.

        :param judged: False for a run that does not judge a robot: it has no verdict and no result
        """
        if (earlier := self._unstored[calibration_id]) is not None:
            return earlier.state
        end = end_of(state, result, reason, self._times.now(calibration_id), judged=judged)
        try:
            return self._end(calibration_id, end)
        except StoreUnavailable as error:
            log.exception("The end of run %d could not be stored; it is repeated", calibration_id)
            return self._unstored.keep(calibration_id, end, error).state

    def repeat_ends(self) -> None:
        """Store the ends that the store did not accept before, if it accepts them now."""
        self._unstored.repeat(self._end)

    def _end(self, calibration_id: int, end: End) -> State:
        """:raises StoreUnavailable:"""
        result = end.result
        with self._writing() as db:
            ended = db.execute(
                "UPDATE calibrations SET state = ?, verdict = ?, outcome = ?, reason = ?, reason_code = ?,"
                " reason_params = ?, ended_ms = max(?, created_ms, coalesce(started_ms, 0))"
                " WHERE id = ? AND state IN (?, ?, ?)",
                [
                    end.state,
                    end.verdict,
                    end.outcome,
                    *reason_columns(end.reason),
                    millis(end.at),
                    calibration_id,
                    *UNFINISHED,
                ],
            ).rowcount
            if ended and result is not None:
                keep_result(db, calibration_id, result)
                if end.verdict == "pass" and result.lasting is not None:
                    db.execute(
                        "INSERT INTO memories (calibration_id, robot_serial, at_ms, memory)"
                        " SELECT id, robot_serial, ended_ms, ? FROM calibrations WHERE id = ?",
                        [result.lasting.model_dump_json(), calibration_id],
                    )
            if ended:
                append(lambda sql, values: db.execute(sql, values).fetchall(), calibration_id)
                self.announce_run("run.ended", calibration_id)
        self._times.end(calibration_id)
        return end.state if ended else self.summary(calibration_id).state

    def interrupt_unfinished(self) -> list[int]:
        """At start-up, mark runs that were queued or running when the station went down as interrupted.

        If the last process knew the end of such a run, that is stored.  Returns the ids.
        """
        rows = self._readers.all("SELECT id FROM calibrations WHERE state IN (?, ?, ?)", list(UNFINISHED))
        known = self._unstored.left_behind()
        ids = [int(row["id"]) for row in rows]
        for run in ids:
            self._end(run, known.get(run) or end_of(State.INTERRUPTED, None, because("interrupted"), now()))
        self._unstored.clear()
        return ids

    def verify(self) -> Verified:
        """Whether every finished run is unchanged since its end."""
        return verify(self._readers.all)

    def in_chain(self, head: str) -> bool:
        """Whether a run has this hash."""
        return self._readers.one("SELECT 1 FROM chain WHERE hash = ?", [head]) is not None

    def calibration(self, calibration_id: int) -> Calibration:
        """One calibration with everything about it.  :raises NotFound:"""
        row = self._run_row(calibration_id, f"{LIST_COLUMNS}, metadata, result")
        return self._as_ended(calibration_from_row(row))

    def diagnosis(self, calibration_id: int) -> DiagnosisDocument:
        """The diagnosis document of a run.  :raises NotFound: no such run, or it has none."""
        row = self._readers.one(
            "SELECT diagnosis FROM results WHERE calibration_id = ? AND diagnosis IS NOT NULL",
            [calibration_id],
        )
        if row is None:
            self.summary(calibration_id)
            raise NotFound(f"Run {calibration_id} has no diagnosis.")
        return document_from(row["diagnosis"])

    def summary(self, calibration_id: int) -> CalibrationSummary:
        """One calibration as the list shows it.  :raises NotFound:"""
        return self._as_ended(summary_from_row(self._run_row(calibration_id, LIST_COLUMNS)))

    def _run_row(self, calibration_id: int, columns: str) -> sqlite3.Row:
        row = self._readers.one(
            f"SELECT {columns} FROM calibrations LEFT JOIN results ON calibration_id = id WHERE id = ?",
            [calibration_id],
        )
        if row is None:
            raise NotFound(f"There is no calibration {calibration_id}.")
        return row

    def calibrations(
        self,
        *,
        limit: int = 50,
        cursor: int | str | None = None,
        order: Order = "newest",
        search: str | None = None,
        robot_serial: str | None = None,
        robot_type: str | None = None,
        state: str | None = None,
        verdict: str | None = None,
        plan: str | None = None,
        work_order: str | None = None,
        since: datetime | None = None,
        until: datetime | None = None,
        ended_since: datetime | None = None,
    ) -> Page:
        """A page of summaries; `cursor` is the `next` of the previous page. Other arguments as in `Filters`.

        :raises InputRefused: the cursor is invalid.
        """
        filters = Filters(
            search, robot_serial, robot_type, state, verdict, plan, work_order, since, until, ended_since
        )
        conditions, values = filters.conditions(
            self._or_unstored, few_found=self._finds_few(search), order=order
        )
        if cursor is not None:
            condition, of_run = beyond(order, row_id(cursor))
            conditions.append(condition)
            values += of_run
        rows = self._readers.all(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id"
            f"{where(conditions)}{ordered(order)} LIMIT ?",
            [*values, limit + 1],
        )
        items = [self._as_ended(summary_from_row(row)) for row in rows[:limit]]
        matching = [item for item in items if state in (None, item.state) and verdict in (None, item.verdict)]
        return Page(matching, items[-1].id if len(rows) > limit else None)

    def count(self, filters: Filters) -> tuple[int, bool]:
        """Number of runs that match these filters, at most `MOST_COUNTED`; and whether there are more."""
        conditions, values = filters.conditions(self._or_unstored, order=None)
        index = " INDEXED BY calibrations_found" if filters.indexed else ""
        found = self._up_to(MOST_COUNTED + 1, f"calibrations{index}{where(conditions)}", values)
        return min(found, MOST_COUNTED), found > MOST_COUNTED

    def _finds_few(self, search: str | None) -> bool:
        conditions, values = Filters(search=search).conditions(self._or_unstored)
        if not search:
            return True
        return self._up_to(FEW + 1, f"calibrations{where(conditions)}", values) <= FEW

    def _up_to(self, most: int, runs: str, values: list[str | int]) -> int:
        some = f"SELECT 1 FROM {runs} LIMIT {most}"
        row = self._readers.one(f"SELECT count(*) AS n FROM ({some})", values)
        return 0 if row is None else int(row["n"])

    def _or_unstored(self, column: str) -> str:
        """SQL that includes runs whose stored state and verdict are not the displayed ones."""
        runs = ", ".join(map(str, self._unstored.runs))
        return f" OR id IN ({runs})" if runs and column in ("verdict", "state") else ""

    def runs_of(self, calibration_id: int) -> list[CalibrationSummary]:
        """Summaries of the runs that applied or rolled back a calibration, oldest first."""
        rows = self._readers.all(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id"
            " WHERE of_id = ? ORDER BY id",
            [calibration_id],
        )
        return [self._as_ended(summary_from_row(row)) for row in rows]

    def _as_ended(self, row: S) -> S:
        """The summary with an end that is not stored yet."""
        end = self._unstored[row.id]
        return row if end is None else end.shown_in(row)

    # Readings and events -----------------------------------------------------------------------

    def add_reading(self, calibration_id: int, reading: Reading, *, wire: bytes = b"") -> None:
        """Committed and on the disk when this returns, with the piece of the wire log up to it."""
        with self._writing():
            self.add_readings(calibration_id, [reading])
            self.add_wire(calibration_id, wire)

    def add_readings(self, calibration_id: int, readings: Sequence[Reading]) -> None:
        """Store several in one transaction, as an import does."""
        marks = ", ".join("?" * 14)
        with self._writing() as db:
            db.conn.executemany(
                f"INSERT INTO readings (calibration_id, {READING_COLUMNS}) VALUES ({marks})",
                [(calibration_id, *reading_row(reading)) for reading in readings],
            )
            db.execute(
                "UPDATE calibrations SET step = step + ? WHERE id = ?", [len(readings), calibration_id]
            )

    def drop_samples(self, ended_before: datetime) -> int:
        """Retain only mean and number of samples of runs that ended before; how many readings changed.

        One run at a time, so that a measurement does not wait; each deletion is recorded as an event.
        """
        rows = self._readers.all(
            "SELECT DISTINCT calibration_id AS run FROM readings JOIN calibrations ON id = calibration_id"
            " WHERE ended_ms < ? AND samples LIKE '[%' ORDER BY run",
            [millis(ended_before)],
        )
        dropped = 0
        for row in rows:
            with self._writing() as db:
                dropped += db.execute(
                    "UPDATE readings SET samples = json_array_length(samples)"
                    " WHERE calibration_id = ? AND samples LIKE '[%'",
                    [row["run"]],
                ).rowcount
                self.add_event(row["run"], "samples_dropped")
        return dropped

    def readings(self, calibration_id: int) -> list[Reading]:
        """In the order they were taken.  :raises NotFound: no such calibration."""
        rows = self._readers.all(
            f"SELECT {READING_COLUMNS} FROM readings WHERE calibration_id = ? ORDER BY reading",
            [calibration_id],
        )
        if not rows:
            self.calibration(calibration_id)
        return [reading_from_row(row) for row in rows]
