"""One run carried out on a machine: connect, move, measure, follow its procedure to the result.

The orchestrator does this with the devices, a replay with the wire log of an earlier run.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta
from typing import Any

from drivers.errors import DeviceError
from station.motion import Cancelled, Clock, Listeners, Machine, Positioner, Retracting, Zeroing
from station.records import (
    Ask,
    CalibrationResult,
    MeasurementSequence,
    Prompt,
    Reading,
    Retract,
    SetZeros,
    State,
    Step,
    uid7,
)
from station.run_kinds import RunKind, Start
from station.service.procedures import follow_procedure
from station.service.run import Run
from station.service.so_far import SoFar
from station.service.traceability import traced
from station.settings import Settings
from station.store import Store

_LOOK_S = 0.05


class Unanswered(Exception):
    """Nobody answered a prompt in time."""

    def __init__(self, text: str, limit_s: float) -> None:
        super().__init__(text)
        self.text, self.limit_s = text, limit_s


@dataclass(frozen=True)
class CarryingOut:
    """One run, on the thread that calls `result`."""

    run: Run
    kind: RunKind
    machine: Machine
    store: Store
    settings: Settings
    listeners: Listeners
    begin_clock: Callable[[float], Clock]
    """Start the clock from the seconds since the run began; between closing and opening all lines."""
    take_wire: Callable[[], bytes]
    """The wire log since the last call, to be stored."""
    answers: Iterator[float | None] | None = None
    """Answers that were given when the run was made; None: people are asked."""

    def result(self) -> CalibrationResult:
        """Carry out the run; every reading is stored before this returns.

        :raises Cancelled: the run was stopped.
        :raises Unanswered: a prompt has expired.
        :raises DeviceError, StepFailed, InputRefused: the run failed; the error states why.
        """
        run, kind = self.run, self.kind
        if run.cancel.is_set():
            raise Cancelled
        self._set_state(State.RUNNING)
        assert kind.procedure is not None
        elapsed_s = self._continue()
        # Every run checks again that the right devices answer, and depends on no earlier state.
        self.machine.release()
        clock = self.begin_clock(elapsed_s)
        positioner = Positioner(self.machine, run.robot, self.settings.joints, run.cancel, clock)
        self.machine.mounted_at(run.robot.c)
        positioner.prepare(from_outside=kind.from_outside)
        zeroing = Zeroing(run.id, self.machine, positioner, self.store)
        zeroing.settle()
        began_at = self.store.summary(run.id).created_at
        so_far = SoFar(run.robot)
        procedure = kind.procedure(Start(self.store, run.request, run.robot, began_at, self.settings.limits))

        def carry_out(step: Step) -> Any:
            match step:
                case MeasurementSequence():
                    return self._sequence(positioner, step, so_far)
                case SetZeros():
                    self._begin(step)
                    so_far.renew()
                    return zeroing.carry_out(step)
                case Retract():
                    self._begin(step)
                    return Retracting(self.machine, positioner).carry_out()
                case Ask():
                    self._begin(step)
                    return self._ask(positioner, step, so_far)

        try:
            result = follow_procedure(procedure, carry_out)
        finally:
            procedure.close()
        if kind.rests_on_scale:
            result = traced(result, self.store.made_by(run.id), began_at.date())
        self.listeners.publish("residuals", run.add_result(result))
        return result

    def _continue(self) -> float:
        """Take over the readings of an earlier run; returns the real time since it started, 0 without one."""
        if self.kind.continues is None:
            return 0.0
        earlier = self.kind.continues(self.store, self.run.request)
        if earlier is None:
            return 0.0
        self.store.add_readings(self.run.id, earlier.readings)
        self.run.inherit(len(earlier.readings))
        return max(earlier.elapsed_s, earlier.readings[-1].t_s / self.machine.devices.speed)

    def _begin(self, step: SetZeros | Retract | Ask) -> None:
        """Begin a step without readings."""
        self.listeners.publish(
            "walk", self.run.begin_sequence(MeasurementSequence(step.title, step.number, ()))
        )
        self.listeners.publish("run", self.run.brief())

    def _sequence(
        self, positioner: Positioner, sequence: MeasurementSequence, so_far: SoFar
    ) -> list[Reading]:
        run = self.run
        self.listeners.publish("walk", run.begin_sequence(sequence))
        self._set_state(State.RUNNING)
        positioner.mount = sequence.mount
        readings = []
        for index, stop in enumerate(sequence.stops):
            try:
                reading = positioner.measure(stop, run.step + 1, sequence.number)
            except DeviceError as error:
                raise self.machine.trip_by(error, f"At position {stop.position}: {error}") from error
            reading = replace(reading, mount=sequence.mount)
            self.store.add_reading(run.id, reading, wire=self.take_wire())
            readings.append(reading)
            row = run.add_reading(index, reading, self.machine.shown_place(reading.theta_deg))
            self.listeners.publish("reading", row)
            if residuals := so_far.add(reading):
                self.listeners.publish("residuals", run.add_residuals(residuals))
            self.listeners.publish("run", run.brief())
        return readings

    def _ask(self, positioner: Positioner, step: Ask, so_far: SoFar) -> float | None:
        """Ask a person at standstill, and return the answer.

        :raises Unanswered: the time limit has expired.
        """
        value = next(self.answers) if self.answers is not None else self._answer(step)
        if step.mounted_at is not None:
            self.machine.mounted_at(step.mounted_at, step.mounting)
            positioner.look()
            if step.mounting:
                so_far.renew()
        self._set_state(State.RUNNING)
        return value

    def _answer(self, step: Ask) -> float | None:
        """Wait for the answer; stop and abort end the wait at once."""
        run, limit_s = self.run, self.settings.limits.prompt_s
        deadline = time.monotonic() + limit_s
        expires_at = datetime.now(UTC) + timedelta(seconds=limit_s)
        run.ask(
            Prompt(id=uid7(), text=step.text, kind=step.kind, unit=step.unit, expires_at=expires_at), step
        )
        self._set_state(State.WAITING)
        while not run.answered.wait(_LOOK_S):
            if run.cancel.is_set():
                raise Cancelled
            if time.monotonic() > deadline:
                raise Unanswered(step.text, limit_s)
        answer = run.take_answer()
        self.store.add_event(
            run.id,
            "answer",
            {"prompt": answer.prompt, "text": step.text, "value": answer.value, "by": answer.by},
        )
        return answer.value

    def _set_state(self, state: State) -> None:
        self.store.set_state(self.run.id, state, steps=self.run.steps)
        self.run.state = state
        self.listeners.publish("run", self.run.brief())
