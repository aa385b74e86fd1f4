"""What today's identification and diagnosis say of stored readings.  Nothing that is stored changes.

The procedure of the run's own kind is followed with the stored readings in place of the machine, with the
memory that took part then, at the age that it had. A kind whose result needs only the readings says so.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, cast

from pydantic import JsonValue

from station.errors import InputRefused, NotFound
from station.messages import labels_in_words
from station.records import (
    Beforehand,
    Calibration,
    CalibrationResult,
    Finding,
    MeasurementSequence,
    Reading,
    Record,
    Step,
)
from station.run_kinds import RUN_KINDS, Start, request_of
from station.service import follow_procedure
from station.store import Store
from station.studies.engine import Engine

KINDS = ("calibrate", "diagnose")
"""Kinds of runs that identify something from their own readings alone."""
SAME_SD, SAME_DEG = 0.01, 1e-6
"""Zero offsets count as the same within this share of their standard uncertainty, or within this angle."""


class Change(Record):
    """One thing that today's software says differently of a run."""

    id: int
    uid: str
    what: str
    """"outcome", "offsets", "causes" or "refused"."""
    before: JsonValue
    after: JsonValue
    reason: str


class Refitted(Record):
    """All runs that were looked at."""

    runs: int
    left_out: int
    """Runs without stored readings of a measurement, or without a result."""
    changed: tuple[Change, ...]
    seconds: float


class _NotRepeatable(Exception):
    """The procedure asks for readings that were not taken then."""


def candidates(store: Store, ids: Sequence[int] = ()) -> list[int]:
    """Runs to look at, oldest first: those of `ids`, else every finished measurement.

    :raises NotFound: no such run.
    """
    if ids:
        return [store.summary(run).id for run in ids]
    out: list[int] = []
    cursor: int | None = None
    while True:
        page = store.calibrations(limit=500, cursor=cursor, state="succeeded")
        out += [item.id for item in page.items if item.kind in KINDS]
        if (cursor := page.next) is None:
            return out[::-1]


def refit(database: Path, runs: Sequence[int], engine: Engine) -> Refitted:
    """Each run of the database at this path, in parallel."""
    began = time.perf_counter()
    found = engine.each(_looked_at, [(database, run) for run in runs], "Runs")
    changed = [change for one in found if one is not None for change in one]
    return Refitted(
        runs=len(runs) - sum(one is None for one in found),
        left_out=sum(one is None for one in found),
        changed=tuple(changed),
        seconds=round(time.perf_counter() - began, 3),
    )


@cache
def _opened(database: Path) -> Store:
    """One a process, for as long as it lives."""
    return Store(database, read_only=True)


def _looked_at(item: tuple[Path, int]) -> list[Change] | None:
    """What is said differently now; None where the run cannot be fitted again."""
    database, run = item
    store = _opened(database)
    before = store.calibration(run)
    readings = store.readings(run)
    if before.kind not in KINDS or before.verdict is None or not readings:
        return None
    try:
        after = refitted(store, before, readings)
    except _NotRepeatable:
        return None
    except InputRefused as refusal:
        return [
            Change(
                id=run, uid=before.uid, what="refused", before=before.outcome, after=None, reason=str(refusal)
            )
        ]
    return list(_changes(before, after))


def refitted(store: Store, before: Calibration, readings: Sequence[Reading]) -> CalibrationResult:
    """The result that the run would have today.

    :raises InputRefused: the readings are not enough to judge any more.
    """
    use, memory = before.memory, cast(Beforehand | None, before.fleet and before.fleet.prior)
    if use is not None:
        try:
            memory = replace(store.memory_left_by(use.from_calibration), as_of=before.created_at)
        except NotFound as error:
            raise _NotRepeatable from error
    kind = RUN_KINDS[before.kind]
    request = request_of(store, before.id)
    robot = store.robot_of(before.id).informed(request.references)
    start = Start(store, request, robot, before.created_at, known_before=lambda: memory)
    if kind.concluded is not None and before.state == "succeeded":
        return kind.concluded(start, list(readings))
    assert kind.procedure is not None
    taken: dict[int, list[Reading]] = {}
    for reading in readings:
        taken.setdefault(reading.sequence, []).append(reading)

    def carry_out(step: Step) -> list[Reading]:
        if not isinstance(step, MeasurementSequence) or step.number not in taken:
            raise _NotRepeatable
        return taken.pop(step.number)

    with closing(kind.procedure(start)) as procedure:
        return follow_procedure(procedure, carry_out)


def _changes(before: Calibration, after: CalibrationResult) -> list[Change]:
    out = []

    def add(what: str, was: JsonValue, now: JsonValue, reason: str) -> None:
        out.append(Change(id=before.id, uid=before.uid, what=what, before=was, after=now, reason=reason))

    if (before.outcome, before.verdict) != (after.outcome, after.verdict):
        was: dict[str, JsonValue] = {
            "verdict": before.verdict, "outcome": before.outcome, "reason": before.reason
        }  # fmt: skip
        now: dict[str, JsonValue] = {
            "verdict": after.verdict, "outcome": after.outcome, "reason": after.reason.text
        }  # fmt: skip
        add("outcome", was, now, f"Then: {before.reason} Now: {after.reason.text}")
    then = {f"dtheta{zero.joint}": zero for zero in before.zero_offsets}
    moved = [
        q
        for q in after.zero_offsets
        if q.name not in then or not _same(then[q.name].value_deg, then[q.name].sd_deg, q.value)
    ]
    if moved or len(then) != len(after.zero_offsets):
        was_deg = {name: zero.value_deg for name, zero in then.items()}
        shown = ", ".join(
            f"{q.name} from {_degrees(was_deg.get(q.name))} to {_degrees(q.value)}" for q in moved
        )
        add(
            "offsets",
            dict(was_deg),
            {q.name: q.value if math.isfinite(q.value) else None for q in after.zero_offsets},
            f"Zero offsets change: {shown or 'their number'}.",
        )
    causes_then = sorted(_label(finding) for finding in before.findings)
    causes_now = sorted(_label(finding) for finding in after.findings)
    if causes_then != causes_now:
        then_named, now_named = (_named(findings) for findings in (before.findings, after.findings))
        add("causes", list(causes_then), list(causes_now), f"Causes then: {then_named}; now: {now_named}.")
    return out


def _same(was: float | None, sd: float | None, now: float) -> bool:
    if was is None or not math.isfinite(now):
        return was is None and not math.isfinite(now)
    return abs(now - was) <= max(SAME_SD * (sd or 0.0), SAME_DEG)


def _degrees(value: float | None) -> str:
    return "none" if value is None or not math.isfinite(value) else f"{value:.4f} deg"


def _named(findings: Sequence[Finding]) -> str:
    return ", ".join(labels_in_words(finding.label, "en") for finding in findings) or "none"


def _label(finding: Any) -> str:
    where = finding.part or (f"joint {finding.joint}" if finding.joint else "")
    return f"{finding.effect} {where}".strip()
