"""Events for other systems, and their delivery to each receiver."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Collection, Mapping, Sequence
from datetime import UTC, datetime
from typing import Literal

from pydantic import JsonValue

from station.errors import NotFound
from station.records import Backlog, Delivery, Event, EventType, State, uid7
from station.store.kept_file import KeptFile
from station.store.rows import LIST_COLUMNS, compact, moment, summary_from_row
from station.store.times import now_ms

_OF_RUNS = ("run.started", "run.ended")
_OF_A_START = ("id", "uid", "robot_serial", "kind", "plan", "of", "operator", "work_order", "created_at")
_DELIVERY = "deliveries.*, uid, type FROM deliveries JOIN happenings USING (n)"


class Outbox(KeptFile):
    """An event is stored together with its cause, so that none is lost and none is invented."""

    def announce(self, type: EventType, data: Mapping[str, JsonValue]) -> None:
        """Add an event; within a transaction it is part of that."""
        with self._writing() as db:
            at_ms = now_ms()
            db.execute(
                "INSERT INTO happenings (uid, type, at_ms, data) VALUES (?, ?, ?, ?)",
                [uid7(at_ms), type, at_ms, compact(dict(data))],
            )

    def announce_run(self, type: Literal["run.started", "run.ended"], run: int) -> None:
        """Add an event of a run; its data are the run's own, and stored only there."""
        self.announce(type, {"run": run})

    def happenings(self, *, after: int = 0, limit: int = 100) -> list[Event]:
        """Events with a higher number, in order."""
        rows = self._readers.all("SELECT * FROM happenings WHERE n > ? ORDER BY n LIMIT ?", [after, limit])
        return self._events(rows)

    def enqueue(self, receiver: str, types: Collection[str]) -> None:
        """Create the deliveries of all new events; a new receiver begins with the next one."""
        last = self._last()
        row = self._readers.one("SELECT seen FROM receivers WHERE name = ?", [receiver])
        if row is not None and row["seen"] == last:
            return
        marks = ", ".join("?" * len(types))
        with self._writing() as db:
            if row is not None:
                db.execute(
                    "INSERT INTO deliveries (receiver, n, state, next_ms) SELECT ?, n, 'waiting', at_ms"
                    f" FROM happenings WHERE n > ? AND n <= ? AND type IN ({marks}) ORDER BY n",
                    [receiver, row["seen"], last, *types],
                )
            db.execute("INSERT OR REPLACE INTO receivers VALUES (?, ?)", [receiver, last])

    def _last(self) -> int:
        row = self._readers.one("SELECT coalesce(max(n), 0) AS n FROM happenings")
        return 0 if row is None else int(row["n"])

    def next_delivery(self, receiver: str) -> tuple[Delivery, Event] | None:
        """The first pending one, in the order of the events, whether it is due or not."""
        row = self._readers.one(
            f"SELECT at_ms, data, {_DELIVERY} WHERE receiver = ? AND state = 'waiting' ORDER BY n LIMIT 1",
            [receiver],
        )
        return None if row is None else (_delivery(row), self._events([row])[0])

    def _events(self, rows: Sequence[sqlite3.Row]) -> list[Event]:
        data = [json.loads(row["data"]) for row in rows]
        of_runs = {k: of["run"] for k, of in enumerate(data) if rows[k]["type"] in _OF_RUNS}
        summaries = self._summaries(of_runs.values())
        for k, run in of_runs.items():
            # a backup from before the run may have replaced the history
            data[k] = _of_run(rows[k]["type"], summaries[run]) if run in summaries else {"id": run}
        return [
            Event(
                n=row["n"],
                uid=row["uid"],
                type=row["type"],
                at=datetime.fromtimestamp(row["at_ms"] / 1000, UTC),
                data=of,
            )
            for row, of in zip(rows, data, strict=True)
        ]

    def _summaries(self, runs: Collection[int]) -> dict[int, dict[str, JsonValue]]:
        marks = ", ".join("?" * len(runs))
        rows = self._readers.all(
            f"SELECT {LIST_COLUMNS} FROM calibrations LEFT JOIN results ON calibration_id = id"
            f" WHERE id IN ({marks})",
            list(runs),
        )
        return {row["id"]: summary_from_row(row).model_dump(mode="json", by_alias=True) for row in rows}

    def postpone(self, delivery_id: int, until: datetime, detail: str) -> None:
        """The delivery failed and is tried again."""
        with self._writing() as db:
            db.execute(
                "UPDATE deliveries SET tries = tries + 1, next_ms = ?, detail = ? WHERE id = ?",
                [round(until.timestamp() * 1000), detail, delivery_id],
            )

    def settle(self, delivery_id: int, state: str, detail: str) -> None:
        """The delivery arrived, or the receiver will never accept it."""
        with self._writing() as db:
            db.execute(
                "UPDATE deliveries SET tries = tries + 1, state = ?, detail = ?, ended_ms = ? WHERE id = ?",
                [state, detail, now_ms(), delivery_id],
            )

    def expire(self, receiver: str, before: datetime, most: int) -> int:
        """Give up deliveries pending for longer, and the oldest of too many; returns their number."""
        with self._writing() as db:
            return db.execute(
                "UPDATE deliveries SET state = 'expired', ended_ms = ?, detail ="
                " 'given up: too old, or too many were waiting'"
                " WHERE state = 'waiting' AND receiver = ? AND (n IN (SELECT n FROM happenings"
                " WHERE at_ms < ?) OR id IN (SELECT id FROM deliveries WHERE receiver = ?"
                " AND state = 'waiting' ORDER BY n DESC LIMIT -1 OFFSET ?))",
                [now_ms(), receiver, round(before.timestamp() * 1000), receiver, most],
            ).rowcount

    def resend(self, delivery_id: int) -> Delivery:
        """Deliver it again, before all later ones.  :raises NotFound:"""
        self.delivery(delivery_id)
        with self._writing() as db:
            db.execute(
                "UPDATE deliveries SET state = 'waiting', tries = 0, next_ms = ?, ended_ms = NULL,"
                " detail = '' WHERE id = ?",
                [now_ms(), delivery_id],
            )
        return self.delivery(delivery_id)

    def delivery(self, delivery_id: int) -> Delivery:
        """:raises NotFound:"""
        row = self._readers.one(f"SELECT {_DELIVERY} WHERE deliveries.id = ?", [delivery_id])
        if row is None:
            raise NotFound(f"There is no delivery {delivery_id}.")
        return _delivery(row)

    def deliveries(
        self, *, state: str | None = None, cursor: int | None = None, limit: int = 100
    ) -> list[Delivery]:
        """Deliveries, newest first; only those before number `cursor`."""
        rows = self._readers.all(
            f"SELECT {_DELIVERY} WHERE state = coalesce(?, state) AND deliveries.id < coalesce(?,"
            " deliveries.id + 1) ORDER BY deliveries.id DESC LIMIT ?",
            [state, cursor, limit],
        )
        return [_delivery(row) for row in rows]

    def backlogs(self) -> list[Backlog]:
        """Pending deliveries of each receiver that has any."""
        rows = self._readers.all(
            "SELECT receiver, count(*) AS count, min(at_ms) AS at_ms FROM deliveries"
            " JOIN happenings USING (n) WHERE state = 'waiting' GROUP BY receiver"
        )
        return [
            Backlog(
                receiver=row["receiver"],
                count=row["count"],
                oldest_at=datetime.fromtimestamp(row["at_ms"] / 1000, UTC),
            )
            for row in rows
        ]


def _of_run(type: str, summary: dict[str, JsonValue]) -> dict[str, JsonValue]:
    """The summary of a run that has ended; for one that began, the part that does not change."""
    if type == "run.ended":
        return summary
    return {**{key: summary[key] for key in _OF_A_START}, "state": State.QUEUED.value}


def _delivery(row: sqlite3.Row) -> Delivery:
    waiting = row["state"] == "waiting"
    return Delivery(
        id=row["id"],
        receiver=row["receiver"],
        event=row["n"],
        uid=row["uid"],
        type=row["type"],
        state=row["state"],
        tries=row["tries"],
        detail=row["detail"],
        next_at=moment(row["next_ms"]) if waiting else None,
        ended_at=moment(row["ended_ms"]),
    )
