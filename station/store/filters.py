"""The filters of a list of runs, as SQL conditions that the indexes of the history support."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from station.store.rows import millis

Order = Literal["newest", "oldest", "serial", "serial_down"]
"""By number, or by serial (case-insensitive) and then by number."""
BY_SERIAL: tuple[Order, ...] = ("serial", "serial_down")
Conditions = tuple[list[str], list[str | int]]
FEW = 2000
"""Up to this many matches of a search are sorted; more are found quickly by a scan in order."""
MOST_COUNTED = 10_000
"""Counting stops here: larger counts are not useful, and a million takes a quarter of a second."""
_AFTER_ALL = "\U0010ffff"


@dataclass(frozen=True, slots=True)
class Filters:
    """All given conditions must hold. Times without a zone are UTC."""

    search: str | None = None
    """Beginning of the serial, case-insensitive."""
    robot_serial: str | None = None
    robot_type: str | None = None
    state: str | None = None
    verdict: str | None = None
    plan: str | None = None
    work_order: str | None = None
    since: datetime | None = None
    """Created then or later."""
    until: datetime | None = None
    """Created before."""
    ended_since: datetime | None = None
    """Ended then or later."""

    @property
    def indexed(self) -> bool:
        """Whether the index `calibrations_found` alone answers the query."""
        others = (
            self.robot_serial,
            self.robot_type,
            self.work_order,
            self.since,
            self.until,
            self.ended_since,
        )
        return bool(self.search) and all(other is None for other in others)

    def conditions(
        self, or_unstored: Callable[[str], str], *, few_found: bool = True, order: Order | None = "newest"
    ) -> Conditions:
        """Conditions on `calibrations` and their values.

        :param or_unstored: includes runs whose stored state is not the displayed one
        :param few_found: whether the search is to choose the index
        :param order: how the list is ordered; by serial, only the index of serials may be chosen; None: not
        """
        by_serial = order in BY_SERIAL
        run = "+id" if by_serial else "id"
        conditions: list[str] = []
        values: list[str | int] = []
        if self.search:
            column = f"{'' if few_found or by_serial else '+'}robot_serial"
            conditions.append(f"{column} COLLATE NOCASE >= ? AND {column} COLLATE NOCASE < ?")
            values += [self.search, self.search + _AFTER_ALL]
        for name in ("work_order", "robot_serial", "robot_type", "verdict", "state", "plan"):
            wanted = getattr(self, name)
            if wanted is not None:
                # Only the first, most selective one may choose the index: + excludes the others.
                conditions.append(f"{'+' if conditions or by_serial else ''}{name} = ?{or_unstored(name)}")
                values.append(wanted)
        other = "+" if conditions else ""
        for time, than, end in ((self.since, ">=", "min"), (self.until, "<", "max")):
            if time is None:
                continue
            made = f"created_ms {than} ?"
            if order is None:
                conditions.append(other + made)
                values.append(millis(time))
            else:
                # times may decrease where the clock was set back: the range narrows, the time decides
                within = f"{run} {than[0]}= (SELECT {end}(id) FROM calibrations WHERE {made})"
                conditions.append(f"{within} AND +{made}")
                values += [millis(time)] * 2
        if self.ended_since is not None:
            conditions.append(f"{'+' if by_serial else ''}ended_ms >= ?")
            values.append(millis(self.ended_since))
        return conditions, values


def beyond(order: Order, run: int) -> tuple[str, list[str | int]]:
    """The condition and its values for runs after that run."""
    than = "<" if order in ("newest", "serial_down") else ">"
    if order not in BY_SERIAL:
        return f"id {than} ?", [run]
    # the second condition narrows the range of the index, which SQLite does not derive from the first
    both = (
        f"(robot_serial COLLATE NOCASE, id) {than} (SELECT robot_serial, id FROM calibrations WHERE id = ?)"
    )
    serial = f"robot_serial COLLATE NOCASE {than}= (SELECT robot_serial FROM calibrations WHERE id = ?)"
    return f"{both} AND {serial}", [run, run]


def ordered(order: Order) -> str:
    """The ORDER BY clause."""
    way = "DESC" if order in ("newest", "serial_down") else "ASC"
    return f" ORDER BY {f'robot_serial COLLATE NOCASE {way}, ' if order in BY_SERIAL else ''}id {way}"


def where(conditions: list[str]) -> str:
    """The WHERE clause; empty without a condition."""
    return f" WHERE {' AND '.join(f'({condition})' for condition in conditions)}" if conditions else ""
