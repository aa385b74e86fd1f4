"""One run while it is active: its request, its cancel event, and the data for the page."""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterable
from dataclasses import dataclass, field
from datetime import UTC, datetime
from threading import Event, Lock

from station.errors import NotApplicable
from station.five_bar import Robot
from station.records import (
    Ask,
    CalibrationRequest,
    CalibrationResult,
    CalibrationSummary,
    Iteration,
    MeasurementSequence,
    Prompt,
    Reading,
    Reason,
    Residual,
    ResidualOfReading,
    RunBrief,
    RunReading,
    RunStop,
    RunView,
    SequenceTitle,
    SequenceView,
    State,
)

Place = tuple[float, float] | None
TO_COME = 8
"""Number of readings assumed while another sequence may follow: the number that verifies a calibration."""


def row_of(reading: Reading, place: Place) -> RunReading:
    """A reading for the page, not judged yet."""
    return RunReading(
        reading=reading.reading,
        position=reading.position,
        x_mm=place and place[0],
        y_mm=place and place[1],
        theta1_deg=reading.theta_deg[0],
        theta2_deg=reading.theta_deg[1],
        scale_mm=reading.scale_mm,
        t_s=reading.t_s,
        walk=reading.sequence,
    )


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to a prompt."""

    prompt: str
    value: float | None
    by: str


@dataclass
class Run:
    """Written by the worker, read by any thread; every view is a copy.

    The sources of clocks and events are looked up when a run is made: a simulation replaces them.
    """

    id: int
    uid: str
    request: CalibrationRequest
    robot: Robot
    cancel: Event = field(default_factory=lambda: Event())
    ended: Event = field(default_factory=lambda: Event())
    stopped_by: str | None = None
    state: State = State.QUEUED
    step: int = 0
    inherited: int = 0
    """Number of steps from an earlier run."""
    steps: int = 0
    iterations: tuple[Iteration, ...] = ()
    prompt: Prompt | None = None
    """The prompt that the run waits for."""
    answered: Event = field(default_factory=lambda: Event())
    _asked: Ask | None = None
    _answer: Answer | None = None
    _sequence: MeasurementSequence | None = None
    _progress: float = 0.0
    _stops: list[RunStop] = field(default_factory=list)
    _readings: list[RunReading] = field(default_factory=list)
    _started: float = field(default_factory=lambda: time.monotonic())
    _started_at: datetime = field(default_factory=lambda: datetime.now(UTC))
    _lock: Lock = field(default_factory=lambda: Lock())

    @property
    def has_moved(self) -> bool:
        """Whether a motion may have been commanded."""
        return self._sequence is not None

    def inherit(self, steps: int) -> None:
        """Continue after the steps of an earlier run."""
        self.inherited = self.step = self.steps = steps

    def ask(self, prompt: Prompt, step: Ask) -> None:
        """Start to wait for an answer."""
        with self._lock:
            self.answered.clear()
            self.prompt, self._asked = prompt, step

    def answer(self, prompt: str, value: float | None, who: str) -> None:
        """:raises NotApplicable: this is not the current prompt.  :raises FieldRefused: the value is
        impossible.
        """
        with self._lock:
            if self.prompt is None or self._asked is None or self.prompt.id != prompt:
                raise NotApplicable(f"Run {self.id} does not ask this (any more).")
            self._answer = Answer(prompt, self._asked.checked(value), who)
            self.prompt = self._asked = None
            self.answered.set()

    def take_answer(self) -> Answer:
        """The answer. Only after `answered`."""
        with self._lock:
            assert self._answer is not None
            return self._answer

    def begin_sequence(self, sequence: MeasurementSequence) -> SequenceView:
        """Begin a sequence. Returns the `walk` event."""
        with self._lock:
            self._sequence = sequence
            self.steps += len(sequence.stops)
            self._stops = [
                RunStop(position=stop.position, x_mm=stop.target_mm[0], y_mm=stop.target_mm[1], done=False)
                for stop in sequence.stops
            ]
            return SequenceView(number=sequence.number, title=sequence.title, stops=tuple(self._stops))

    def add_reading(self, index: int, reading: Reading, place: Place) -> RunReading:
        """Reading of the sequence's stop `index`, already stored.  Returns the `reading` event."""
        row = row_of(reading, place).model_copy(update={"sd_mm": statistics.stdev(reading.samples_mm)})
        with self._lock:
            self.step += 1
            self._stops[index] = self._stops[index].model_copy(update={"done": True})
            self._readings.append(row)
            return row

    def add_result(self, result: CalibrationResult) -> list[ResidualOfReading]:
        """Returns the `residuals` event."""
        self.iterations = result.iterations
        return self.add_residuals(result.residuals)

    def add_residuals(self, rows: Iterable[Residual]) -> list[ResidualOfReading]:
        """Returns the `residuals` event."""
        residuals = {row.reading: row for row in rows}
        with self._lock:
            for k, row in enumerate(self._readings):
                if found := residuals.get(row.reading):
                    judged = {"residual_mm": found.residual_mm, "limit_mm": found.limit_mm}
                    self._readings[k] = row.model_copy(update=judged)
            return [
                ResidualOfReading(reading=r.reading, residual_mm=r.residual_mm, limit_mm=r.limit_mm)
                for r in self._readings
            ]

    def brief(self) -> RunBrief:
        """The `run` event: without stops and readings."""
        with self._lock:
            return self._brief()

    def view(self) -> RunView:
        """The `run` part of the snapshot."""
        with self._lock:
            return RunView(**dict(self._brief()), stops=tuple(self._stops), readings=tuple(self._readings))

    def _brief(self) -> RunBrief:
        elapsed_s = time.monotonic() - self._started
        sequence, request = self._sequence, self.request
        to_do = sum(not stop.done for stop in self._stops)
        own = self.step - self.inherited
        return RunBrief(
            id=self.id,
            uid=self.uid,
            state=self.state,
            robot_serial=request.robot_serial,
            kind=request.kind,
            plan=request.label,
            of=request.of,
            operator=request.operator,
            work_order=request.work_order,
            started_at=self._started_at,
            elapsed_s=round(elapsed_s, 1),
            remaining_s=round(to_do * elapsed_s / own, 1) if own else None,
            walk=SequenceTitle(number=sequence.number, title=sequence.title) if sequence else None,
            progress=round(self._so_far(own), 4),
            step=self.step,
            steps=self.steps,
            iterations=self.iterations,
            prompt=self.prompt,
        )

    def _so_far(self, own: int) -> float:
        """Share of the run that is complete; steps announced later slow it down, but never reduce it."""
        follows = 0 if self._sequence is not None and self._sequence.last else TO_COME
        self._progress = max(self._progress, own / max(self.steps - self.inherited + follows, 1))
        return self._progress

    def unread(self, reason: Reason) -> CalibrationSummary:
        """How it ended, if the store does not return it."""
        brief = self.brief()
        return CalibrationSummary(
            id=self.id,
            uid=self.uid,
            robot_serial=brief.robot_serial,
            kind=brief.kind,
            plan=brief.plan,
            of=brief.of,
            operator=brief.operator,
            work_order=brief.work_order,
            state=self.state,
            verdict=None,
            outcome="failed" if self.state is State.FAILED else None,
            step=brief.step,
            steps=brief.steps,
            started_at=brief.started_at,
            reason=reason.text,
            reason_code=reason.code,
            reason_params=reason.params,
            created_at=brief.started_at or datetime.now(UTC),
        )
