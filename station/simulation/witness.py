"""External observation of a working station, and the invariants that must hold for it.

The witness observes the page's data, the machine, the receiver's events and the disk; it has no access to the
station's internals.
"""

from __future__ import annotations

import hashlib
import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from pydantic_core import to_json

from station.motion import LiveEvent
from station.records import Calibration, CalibrationSummary, RunBrief, RunReading, State
from station.simulation.clients import Answer
from station.simulation.plant import Plant
from station.store import Store

STANDSTILL_S = 0.5
"""Time after the end of a run within which an axis may still brake."""
STOP_S = 0.45
"""Time after STOP within which an axis that answers may still move: the other one does not delay it."""
TRUE_WITHIN_SDS = 6.0
SAME_FRAME_DEG = 0.01
"""Allowed difference between the journal's sum of shifts and a drive's zero: a few pulses for each write."""
_BEGINS = ("run.started", "run.applied", "run.rolled_back")
_UNFINISHED = (State.QUEUED, State.RUNNING, State.WAITING)
_MANY = 1_000_000
_NOT_NOW = (401, 429, 503)
_IN_A_SENTENCE = (400, 401, 403, 404, 409, 422, 429, 502, 503, 504)

INVARIANTS = {
    "readings": "No reading that was shown is lost or changed.",
    "evidence": "A run passes only with fresh readings, finite numbers, true zero offsets and no jump.",
    "one": "Only one run is active at a time.",
    "standstill": "Both axes stand still soon after every confirmed stop, and after the end of every run.",
    "undisturbed": "A run that nothing disturbs succeeds.",
    "motion": "Nothing moves without a command of a running station.",
    "idle": "The station can return to idle from every state, and the next run can start.",
    "journal": "The journal of zeros agrees with the drives to within a few pulses.",
    "key": "An idempotency key starts only one run, also across restarts.",
    "deliveries": "The end of every run reaches all receivers and clients of events, in order.",
    "chains": "The chains of the records and of the audit are complete.",
    "audit": "The audit names the requester of every start, abort and stop, exactly once.",
    "access": "Nothing starts or stops without a valid key or session and the permission for it.",
    "times": "A run is created before it starts and starts before it ends, whatever the clock does.",
    "ends": "The end of a run is reported once and is never changed.",
    "start": "The station starts whenever its disk is intact.",
    "threads": "No thread of the station ends with an error.",
    "answer": "Every request is answered, and a refusal states its reason in a sentence.",
}
"""Invariants by the name under which a violation is reported."""


@dataclass(frozen=True, slots=True)
class Violation:
    """One invariant that did not hold."""

    invariant: str
    at_s: float
    detail: str


@dataclass
class Witness:
    """Collects observations, and checks them."""

    plant: Plant
    violations: list[Violation] = field(default_factory=list)
    readings: int = 0
    """Readings shown so far."""
    runs: int = 0
    """Runs stored so far."""
    _trace: hashlib._Hash = field(default_factory=hashlib.sha256)
    _shown: dict[str, dict[int, RunReading]] = field(default_factory=dict)
    _told: dict[str, State] = field(default_factory=dict)
    _keys: dict[str, int] = field(default_factory=dict)
    _disturbed: set[int] = field(default_factory=set)
    _jumped_after: dict[int, int] = field(default_factory=dict)
    """Number of a run's readings when the readout jumped."""
    _seen: int = 0
    """Number of the last checked run."""
    _current: RunBrief | None = None
    _started_by: Counter[tuple[str, str, str]] = field(default_factory=Counter)
    _done_late: Counter[tuple[str, str, str]] = field(default_factory=Counter)
    """Actions since the last kill."""
    _pulled: set[str] = field(default_factory=set)
    _last_pulled: int = 0

    def fails(self, invariant: str, detail: str) -> None:
        """An invariant does not hold."""
        self.violations.append(Violation(invariant, self.plant.scheduler.now_s, detail))

    @property
    def digest(self) -> str:
        """SHA-256 of all events so far."""
        return self._trace.hexdigest()

    def _happens(self, what: str) -> None:
        self._trace.update(f"{self.plant.scheduler.now_s:.6f} {what}\n".encode())

    # Data of the page, and answers to requests ----------------------------------------------------

    def heard(self, event: LiveEvent) -> None:
        """Listener of the running station."""
        data = event.data
        self._happens(f"{event.type} {to_json(data).decode()}")
        if isinstance(data, RunBrief):
            self._current = data
        elif isinstance(data, RunReading) and self._current is not None:
            self.readings += 1
            self._shown.setdefault(self._current.uid, {})[data.reading] = data
        elif isinstance(data, CalibrationSummary):
            self._ended(data)

    def _ended(self, run: CalibrationSummary) -> None:
        if run.uid in self._told or run.state in _UNFINISHED:
            self.fails("ends", f"run {run.id} is told to have ended, {run.state}, at the wrong time")
        self._told[run.uid] = run.state
        unsure = run.reason is not None and "tandstill could not be confirmed" in run.reason
        if self._moves_s() > STANDSTILL_S and not unsure:
            self.fails("standstill", f"run {run.id} has ended; an axis moves {self._moves_s():.2f} s more")

    def started(self, key: str, run: int) -> None:
        """A start was answered."""
        if self._keys.setdefault(key, run) != run:
            self.fails("key", f"key {key} started run {self._keys[key]} and run {run}")

    def refused(self, key: str, status: int) -> None:
        """A start was refused; one that was accepted before is answered again, unless the disk fails."""
        if key in self._keys and status not in _NOT_NOW:
            self.fails("key", f"key {key} started run {self._keys[key]} and is now answered {status}")

    def started_by(self, who: str, action: str, run: int) -> None:
        """The author of an accepted start; a repetition is the same start."""
        self._started_by[who, action, f"run {run}"] = 1

    def done(self, who: str, action: str, subject: str) -> None:
        """An action was confirmed that the audit records later; a kill in the same minute may prevent it."""
        self._done_late[who, action, subject] += 1

    def answered(self, answer: Answer) -> None:
        """Check any answer: a refusal must have a sentence."""
        if answer.status >= 400 and not (answer.status in _IN_A_SENTENCE and _says_why(answer.body)):
            self.fails("answer", f"status {answer.status}: {answer.body}")

    def without_right(self, answer: Answer) -> None:
        """A request was made without the permission."""
        if answer.status not in (401, 403):
            self.fails("access", f"who may not was answered {answer.status}: {answer.body}")

    def pulled(self, events: list[Mapping[str, Any]]) -> None:
        """Events fetched by the MES."""
        for event in events:
            if event["n"] <= self._last_pulled:
                self.fails("deliveries", f"event {event['n']} was fetched after {self._last_pulled}")
            self._last_pulled = event["n"]
            if event["type"] == "run.ended":
                self._pulled.add(event["data"]["uid"])

    def all_pulled(self, store: Store) -> None:
        """Called after the MES has fetched everything."""
        for run in store.calibrations(limit=_MANY, order="oldest").items:
            if run.uid not in self._pulled:
                self.fails("deliveries", f"the end of run {run.id} is not among the events")

    def second_start(self, holder: int, run: int) -> None:
        """Another start was accepted while a run held the rig, unless that had just ended."""
        runtime = self.plant.runtime
        if runtime is not None and not runtime.store.summary(holder).state.ended:
            self.fails("one", f"run {run} was started while run {holder} was under way")

    def stopped(self, pressed_s: float, outcome: dict[str, str | None]) -> None:
        """A stop was answered."""
        for axis, (name, trouble) in zip(self.plant.machine.axes, sorted(outcome.items()), strict=True):
            late_s = axis.rests_from_s - pressed_s
            if trouble is None and late_s > STOP_S:
                self.fails("standstill", f"{name} confirmed the stop and stood {late_s:.2f} s after it")

    def undisturbed(self, run: int, store: Store) -> None:
        """A run has ended without any disturbance."""
        summary = store.summary(run)
        if summary.state is not State.SUCCEEDED and summary.reason_code != "prompt_expired":
            self.fails("undisturbed", f"run {run} is {summary.state}: {summary.reason}")

    def jump(self, run: int) -> None:
        """The readout jumps at its next value."""
        self._jumped_after[run] = len(self._shown.get(self._current.uid, {})) if self._current else 0

    def disturb(self, run: int) -> None:
        """The machine or its readout is changed during a run: its true values are no reference for it."""
        self._disturbed.add(run)

    def off(self, since_s: float) -> None:
        """The station was killed."""
        self._done_late.clear()
        if self.plant.machine.commanded_s > since_s:
            self.fails("motion", "a motion began while no station ran")

    def _moves_s(self) -> float:
        return max(0.0, self.plant.machine.rests_from_s - self.plant.scheduler.now_s)

    # Content of the disk --------------------------------------------------------------------------

    def look(self, store: Store) -> None:
        """Check the disk while no run is active and it has no fault."""
        while self.plant.scheduler.failures:
            self.fails("threads", self.plant.scheduler.failures.pop())
        fresh = store.calibrations(limit=_MANY, order="oldest", cursor=self._seen or None).items
        for run in fresh:
            self._look_at_run(store, run)
            self._happens(f"kept {run}")
        self.runs += len(fresh)
        self._shown.clear()
        self._seen = max([self._seen, *(run.id for run in fresh)])

    def look_at_all(self, store: Store) -> None:
        """Check everything at the end of a day, after all deliveries."""
        self.look(store)
        if (broken := store.verify().broken) is not None:
            self.fails("chains", f"the chain of records breaks at run {broken.id}")
        if (entry := store.check_audit().broken) is not None:
            self.fails("chains", f"the audit breaks at entry {entry}")
        for number, serial in enumerate(self.plant.serials):
            self._look_at_journal(store, number, serial)
        runs = store.calibrations(limit=_MANY, order="oldest").items
        self._look_at_deliveries(runs)
        audit = store.audit(limit=_MANY)
        begun = Counter(entry.subject for entry in audit if entry.action in _BEGINS)
        self._look_at_deeds(Counter((entry.who, entry.action, entry.subject) for entry in audit))
        for run in runs:
            if (times := begun[f"run {run.id}"]) != 1:
                self.fails("audit", f"the start of run {run.id} is in it {times} times")
            if (told := self._told.get(run.uid)) is not None and run.state != told:
                self.fails("ends", f"run {run.id} was told to be {told} and is kept as {run.state}")

    def _look_at_deeds(self, audit: Counter[tuple[str | None, str, str]]) -> None:
        for (who, action, subject), times in (self._started_by + self._done_late).items():
            # the panel's stop needs no session, and is the panel's if that of the operator has ended
            if audit[who, action, subject] + audit["panel", action, subject] < times:
                self.fails("audit", f"{action}, {subject}, by {who} is not in it")

    def _look_at_run(self, store: Store, run: CalibrationSummary) -> None:
        kept = {reading.reading: reading for reading in store.readings(run.id)}
        for number, row in self._shown.get(run.uid, {}).items():
            reading = kept.get(number)
            if reading is None:
                self.fails("readings", f"reading {number} of run {run.id} was shown and is not kept")
            elif (reading.scale_mm, *reading.theta_deg) != (row.scale_mm, row.theta1_deg, row.theta2_deg):
                self.fails("readings", f"reading {number} of run {run.id} is kept otherwise than shown")
        if run.state in _UNFINISHED:
            self.fails("one", f"run {run.id} is kept as {run.state}, and no run is under way")
        times = [time for time in (run.created_at, run.started_at, run.ended_at) if time is not None]
        if times != sorted(times):
            self.fails("times", f"the times of run {run.id} are in the wrong order")
        if run.verdict == "pass":
            self._look_at_pass(store.calibration(run.id))

    def _look_at_pass(self, run: Calibration) -> None:
        read_back_alone = run.kind == "rollback"  # zeros rolled back before any verification
        if run.state is not State.SUCCEEDED or not (run.step or read_back_alone):
            self.fails("evidence", f"run {run.id} passed as {run.state} with {run.step} readings")
            return
        if run.kind not in ("calibrate", "diagnose"):
            return
        if 0 < self._jumped_after.get(run.id, 0) < (run.step or 0) - 1:
            self.fails("evidence", f"run {run.id} passed, and the readout jumped on the way")
        fresh = run.after.fresh_reading_rms_mm if run.after else None
        predicted = run.plan == "adaptive"  # each reading is predicted before it is used
        if not predicted and (fresh is None or not math.isfinite(fresh)):
            self.fails("evidence", f"run {run.id} passed without fresh readings")
        offsets = [(zero.value_deg, zero.sd_deg) for zero in run.zero_offsets]
        known = [(v, sd) for v, sd in offsets if v is not None and sd is not None and math.isfinite(v + sd)]
        if len(known) != 2:
            self.fails("evidence", f"run {run.id} passed with zero offsets {offsets}")
        elif run.id not in self._disturbed:
            # the run is the last one of this machine: its drives have the measured zeros
            true_deg = [axis.zero_offset_deg for axis in self.plant.machine.axes]
            for joint, ((value, sd), true) in enumerate(zip(known, true_deg, strict=True), start=1):
                if abs(value - true) > TRUE_WITHIN_SDS * sd:
                    self.fails(
                        "evidence", f"run {run.id} passed with joint {joint} {(value - true) / sd:.1f} sd off"
                    )

    def _look_at_journal(self, store: Store, number: int, serial: str) -> None:
        writes = store.zero_writes(serial)
        if any(write.taken is None for write in writes):
            return  # in doubt, and reported so: the next run settles it
        machine = self.plant.machines[number]
        for joint, axis in enumerate(machine.axes, start=1):
            shifts = [write.shift_deg or 0.0 for write in writes if write.joint == joint]
            held_deg = axis.zero_offset_deg - self.plant.first_offsets_deg[number][joint - 1]
            if abs(sum(shifts) - held_deg) > SAME_FRAME_DEG * max(1, len(shifts)):
                self.fails(
                    "journal",
                    f"joint {joint} of {serial} holds {held_deg:.3f} deg, the journal says {sum(shifts):.3f}",
                )

    def _look_at_deliveries(self, runs: list[CalibrationSummary]) -> None:
        for name, receiver in self.plant.receivers.items():
            first_of_each = list(dict.fromkeys(n for n, _ in receiver.taken))
            if first_of_each != sorted(first_of_each):
                self.fails("deliveries", f"events overtook each other on the way to {name}")
            reached = {uid for _, uid in receiver.taken}
            for run in runs:
                if run.uid not in reached:
                    self.fails("deliveries", f"the end of run {run.id} did not reach {name}")


def _says_why(body: object) -> bool:
    return isinstance(body, Mapping) and bool(body.get("detail") or body.get("axes"))
