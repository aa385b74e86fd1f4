"""Runs calibrations one at a time: states, the worker that walks, abort, stop, make-safe.

One worker thread does all ordinary work with the devices, so that nothing has to share them; while
nothing runs it looks at the machine twice a second.  `stop` and `abort` work from any thread and go
to the drives directly, past the worker and past every queue.
"""

from __future__ import annotations

import hashlib
import logging
import sqlite3
from collections.abc import Callable
from dataclasses import asdict, dataclass
from queue import Empty, Queue
from threading import Lock, Thread
from typing import Any

from drivers.errors import DeviceError
from station.errors import Busy, InputRefused, KeyReused, NotFound, StepFailed
from station.five_bar import Robot
from station.motion import Cancelled, Devices, Listener, Listeners, LiveEvent, Machine, Walker, Zeroing
from station.records import (
    CalibrationRequest,
    CalibrationResult,
    PlanName,
    Procedure,
    Reading,
    RunKind,
    SetZeros,
    State,
    Submitted,
    Walk,
)
from station.run_kinds import check_separating, learned, since_start_s, start_application, start_separating
from station.service.run import Run
from station.settings import Settings
from station.store import Store, check_apply, check_roll_back, compact, rolled_back_by

__all__ = ["Busy", "InputRefused", "KeyReused", "LiveEvent", "NotFound", "Orchestrator", "Submitted"]

log = logging.getLogger(__name__)

IDLE_S = 0.5
SHUTDOWN_LIMIT_S = 10.0

_CHECKS: dict[RunKind, Callable[[Store, int], None]] = {
    "apply": check_apply,
    "rollback": check_roll_back,
    "separating": check_separating,
}
"""Whether the run that another one is about allows it."""

ProcedureFactory = Callable[[PlanName, Robot], Procedure]


@dataclass(frozen=True, slots=True)
class _Ending:
    state: State
    reason: str = ""
    result: CalibrationResult | None = None


class Orchestrator:
    """The station's only way to move; every method may be called from any thread."""

    def __init__(
        self, devices: Devices, store: Store, settings: Settings, procedure_factory: ProcedureFactory
    ) -> None:
        self._store = store
        self._settings = settings
        self._start_procedure = procedure_factory
        self._listeners = Listeners()
        self._machine = Machine(devices, settings.limits, self._listeners)
        self._submitting = Lock()
        self._lock = Lock()
        self._run: Run | None = None
        self._last = store.last_on_rig()
        self._closing = False
        self._queue: Queue[Run | None] = Queue()
        self._worker = Thread(target=self._work, name="orchestrator", daemon=True)
        self._worker.start()

    # Asking for runs -----------------------------------------------------------------------------

    def submit(self, request: CalibrationRequest, *, idempotency_key: str | None = None) -> Submitted:
        """Start a run, or find the one that this key started.

        :raises Busy: another run holds the rig.
        :raises KeyReused: the key came with another request.
        :raises InputRefused: the robot does not fit this station, or the station is shutting down.
        :raises NotApplicable: the offsets of the run it is about cannot be written or taken back.
        """
        body_hash = hashlib.sha256(compact(asdict(request)).encode()).digest()[:16]
        with self._submitting:
            if idempotency_key is not None:
                known = self._store.find_key(idempotency_key, body_hash)
                if known is not None:
                    return Submitted(known, created=False)
            if self._closing:
                raise InputRefused("The station is shutting down; start it again first.")
            if (holder := self._run) is not None:
                raise Busy(holder.id)
            robot = self._robot(request.robot_serial)
            if request.of is not None:
                _CHECKS[request.plan](self._store, request.of)
            calibration_id = self._store.create(request, robot, key=idempotency_key, body_hash=body_hash)
            run = Run(calibration_id, request, robot)
            with self._lock:
                self._run = run
        self._listeners.publish("run", run.brief())
        self._queue.put(run)
        return Submitted(calibration_id, created=True)

    def apply(self, calibration_id: int, operator: str, *, idempotency_key: str | None = None) -> Submitted:
        """Write the offsets of a passed run to the drives, verify, roll back by itself when that fails.

        :raises NotFound: there is no such run; else as `submit`.
        """
        serial = self._store.summary(calibration_id)["robot_serial"]
        request = CalibrationRequest(serial, "apply", operator, of=calibration_id)
        return self.submit(request, idempotency_key=idempotency_key)

    def roll_back(self, calibration_id: int, operator: str) -> Submitted:
        """Put the zeros back that the drives had before a run was applied; again is harmless.

        :raises NotFound: there is no such run; else as `submit`.
        """
        done = rolled_back_by(self._store, calibration_id)
        if done is not None:
            return Submitted(done, created=False)
        serial = self._store.summary(calibration_id)["robot_serial"]
        return self.submit(CalibrationRequest(serial, "rollback", operator, of=calibration_id))

    def separate(
        self, calibration_id: int, operator: str, *, idempotency_key: str | None = None
    ) -> Submitted:
        """Tell the cause that a diagnostic run found from its look-alikes by more readings.

        :raises NotFound: there is no such run, or it has no diagnosis; else as `submit`.
        """
        serial = self._store.summary(calibration_id)["robot_serial"]
        request = CalibrationRequest(serial, "separating", operator, of=calibration_id)
        return self.submit(request, idempotency_key=idempotency_key)

    def _robot(self, serial: str) -> Robot:
        """The kept robot file, else the paper's Table 1, checked against the drives' scaling."""
        robot = self._store.robot_or_nominal(serial)
        for joint, settings in enumerate(self._settings.joints, start=1):
            wanted, has = asdict(robot.scaling(joint)), asdict(settings.scaling)
            differing = [
                f"{key} {wanted[key]} instead of {has[key]}" for key in has if wanted[key] != has[key]
            ]
            if differing:
                raise InputRefused(
                    f"Robot {serial} does not fit this station's drives: joint {joint} has"
                    f" {', '.join(differing)}; correct its [joints] or the station's [[servo.joint]]."
                )
        return robot

    def abort(self, calibration_id: int, who: str = "the operator") -> None:
        """End a run at once and bring the machine to standstill; again, or after its end, is harmless.

        :raises NotFound: there is no such run.
        """
        run = self._run
        if run is not None and run.id == calibration_id:
            self._halt(run, who)
        else:
            self._store.calibration(calibration_id)

    def stop(self, who: str) -> dict[str, str | None]:
        """Quick stop of both axes, now, whatever else happens; a run that is under way is aborted.

        Returns, by axis, None when it confirmed the stop, else what went wrong.
        """
        return self._halt(self._run, who)

    def _halt(self, run: Run | None, who: str) -> dict[str, str | None]:
        if run is not None:
            run.stopped_by = run.stopped_by or who
            run.cancel.set()
        outcome = self._machine.quick_stop()
        trouble = {name: text for name, text in outcome.items() if text}
        log.warning("Stop by %s: %s", who, trouble or "both axes confirmed")
        try:
            self._store.add_event(run.id if run else None, "stop", {"by": who, **trouble})
        except sqlite3.Error:
            log.exception("The stop could not be recorded")  # it was carried out all the same
        return outcome

    def wait(self, calibration_id: int, timeout_s: float | None = None) -> State:
        """Until the run has ended or the time is over; its state then.  :raises NotFound:"""
        run = self._run
        if run is not None and run.id == calibration_id and not run.ended.wait(timeout_s):
            return run.state
        return State(self._store.calibration(calibration_id)["state"])

    def shutdown(self) -> None:
        """Abort what runs, make the machine safe, end the worker, close the devices.  Twice is harmless."""
        with self._submitting:
            first, self._closing = not self._closing, True
        if first:
            if self._run is not None:
                self._halt(self._run, "the station's shutdown")
            self._queue.put(None)
        self._worker.join(SHUTDOWN_LIMIT_S)
        if self._worker.is_alive():
            log.error("The worker hangs in a device; the run will be marked interrupted at the next start")
        self._machine.close()

    # Watching ------------------------------------------------------------------------------------

    def subscribe(self, listener: Listener) -> Callable[[], None]:
        """Every event from now on, called in the worker's thread; returns the way to unsubscribe."""
        return self._listeners.subscribe(listener)

    def snapshot(self) -> dict[str, Any]:
        """Everything a page needs, as docs/architecture.md says.  Never waits for a device."""
        with self._lock:
            run, last = self._run, self._last
        robot = run.robot if run else self._machine.robot
        return {
            "station": {
                "name": self._settings.name,
                "emulated": self._machine.devices.emulated,
                "limits": self._settings.limits.model_dump(),
            },
            "devices": self._machine.device_views(),
            "interlocks": self._machine.interlocks(),
            "machine": self._machine.view(),
            "workspace": {"x": list(robot.workspace_x), "y": list(robot.workspace_y)},
            "run": run and run.view(),
            "last": last,
        }

    # The worker ----------------------------------------------------------------------------------

    def _work(self) -> None:
        while True:
            try:
                run = self._queue.get(timeout=IDLE_S)
            except Empty:
                self._watch()
                continue
            if run is None:
                return
            self._execute(run)

    def _watch(self) -> None:
        try:
            self._machine.watch()
        except Exception:  # the worker must outlive whatever an idle device does
            log.exception("Looking at the idle machine failed")

    def _execute(self, run: Run) -> None:
        ending = self._perform(run)
        ending = self._bring_to_rest(run, ending)
        try:
            run.state = self._store.finish(run.id, ending.state, ending.result, ending.reason)
            summary = self._store.summary(run.id)
        except sqlite3.Error as error:
            log.exception(
                "The end of run %d could not be stored; the next start marks it interrupted", run.id
            )
            run.state = State.FAILED
            reason = f"The end of the run could not be stored: {error}."
            summary = {
                **run.brief(),
                "state": "failed",
                "verdict": None,
                "reason": reason,
                "zero_offsets": [],
            }
        with self._lock:
            self._last, self._run = summary, None
        run.ended.set()
        self._listeners.publish("ended", summary)

    def _perform(self, run: Run) -> _Ending:
        try:
            result = self._calibrate(run)
        except Cancelled:
            return _Ending(State.ABORTED)
        except (DeviceError, StepFailed, InputRefused) as error:
            return _Ending(State.FAILED, str(error))
        except sqlite3.Error as error:
            log.exception("Run %d cannot be stored", run.id)
            return _Ending(State.FAILED, f"The database does not take what was measured: {error}.")
        except Exception as error:  # the worker must outlive any mistake in a procedure
            log.exception("Run %d failed unexpectedly", run.id)
            return _Ending(State.FAILED, f"Unexpected {type(error).__name__}: {error}")
        return _Ending(State.SUCCEEDED, result.reason, result)

    def _bring_to_rest(self, run: Run, ending: _Ending) -> _Ending:
        """Always: standstill is seen, or the run says that it was not.  A stop pressed late counts."""
        if ending.state is State.SUCCEEDED and not run.cancel.is_set():
            doubt = self._machine.standstill()
            if doubt is None:
                return ending
            ending = _Ending(State.FAILED)
            self._machine.make_safe()
        else:
            doubt = self._machine.make_safe(insist=run.has_moved)
            if not run.has_moved:
                doubt = None
        if run.cancel.is_set():
            ending = _Ending(State.ABORTED, f"Stopped by {run.stopped_by}.")
        return _Ending(ending.state, " ".join(part for part in (ending.reason, doubt) if part))

    def _calibrate(self, run: Run) -> CalibrationResult:
        if run.cancel.is_set():
            raise Cancelled
        self._set_state(run, State.RUNNING)
        walker = Walker(self._machine, run.robot, self._settings.joints, run.cancel)
        walker.prepare()
        zeroing = Zeroing(run.id, self._machine, walker, self._store)
        zeroing.settle()
        if run.request.plan == "separating":
            self._go_on(run, walker)
        procedure = self._procedure(run)

        def carry_out(step: Walk | SetZeros) -> Any:
            return self._walk(run, walker, step) if isinstance(step, Walk) else self._set(run, zeroing, step)

        try:
            result = _follow(procedure, carry_out)
        finally:
            procedure.close()
        self._listeners.publish("residuals", run.add_result(result))
        return result

    def _go_on(self, run: Run, walker: Walker) -> None:
        """With the readings and the clock of the run before."""
        of = run.request.of or 0
        readings = learned(self._store.readings(of))
        self._store.add_readings(run.id, readings)
        run.inherit(len(readings))
        last_s = readings[-1].t_s / self._machine.devices.speed
        walker.started -= max(since_start_s(self._store, of, run.id), last_s)

    def _procedure(self, run: Run) -> Procedure:
        request = run.request
        if request.plan == "apply" or request.plan == "rollback":
            return start_application(self._store, request)
        if request.plan == "separating":
            return start_separating(self._store, request)
        if request.plan == "dataset":
            raise InputRefused("A data set is imported, not run.")
        return self._start_procedure(request.plan, run.robot)

    def _set(self, run: Run, zeroing: Zeroing, step: SetZeros) -> tuple[float, float]:
        self._listeners.publish("walk", run.begin_walk(Walk(step.title, step.number, ())))
        self._listeners.publish("run", run.brief())
        return zeroing.carry_out(step)

    def _walk(self, run: Run, walker: Walker, walk: Walk) -> list[Reading]:
        self._listeners.publish("walk", run.begin_walk(walk))
        self._set_state(run, State.RUNNING)
        readings = []
        for index, stop in enumerate(walk.stops):
            try:
                reading = walker.measure(stop, run.step + 1, walk.number)
            except DeviceError as error:
                raise StepFailed(f"At position {stop.position}: {error}") from error
            self._store.add_reading(run.id, reading)
            readings.append(reading)
            row = run.add_reading(index, reading, self._machine.shown_place(reading.theta_deg))
            self._listeners.publish("reading", row)
            self._listeners.publish("run", run.brief())
        return readings

    def _set_state(self, run: Run, state: State) -> None:
        self._store.set_state(run.id, state, steps=run.steps)
        run.state = state
        self._listeners.publish("run", run.brief())


def _follow(procedure: Procedure, carry_out: Callable[[Walk | SetZeros], Any]) -> CalibrationResult:
    """Step by step to the result.

    What a step fails with is raised in the procedure, which may have a way back.
    """
    try:
        step = next(procedure)
        while True:
            try:
                answer = carry_out(step)
            except (DeviceError, StepFailed) as error:
                step = procedure.throw(error)
            else:
                step = procedure.send(answer)
    except StopIteration as end:
        result: CalibrationResult = end.value
        return result
