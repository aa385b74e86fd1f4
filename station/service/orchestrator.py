"""Runs calibrations one at a time: states, worker thread, abort, stop, make-safe.

One worker thread does all ordinary work with the devices, so they are never shared; between runs it queries
the machine twice a second.  `stop` and `abort` work from any thread and go to the drives directly, past the
worker and past every queue.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping
from functools import partial
from queue import Empty, Queue
from threading import Lock, Thread
from typing import Any, TypeVar

from drivers.errors import DeviceError
from station.errors import (
    Busy,
    InputRefused,
    KeyReused,
    NotApplicable,
    NotFound,
    StepFailed,
    StoreUnavailable,
)
from station.messages import display_name
from station.motion import (
    Cancelled,
    Devices,
    Listener,
    Listeners,
    LiveEvent,
    Machine,
)
from station.plans import PLANS, RECOMMENDED
from station.records import (
    STATION,
    Actor,
    CalibrationHolds,
    CalibrationRequest,
    DeviceDetail,
    Prompt,
    RunView,
    State,
    StationInfo,
    StationView,
    Submitted,
    Workspace,
    because,
    uid7,
)
from station.run_kinds import RUN_KINDS, RunKind, calibration_holds, clear_failed_check
from station.service.carrying_out import CarryingOut, Unanswered
from station.service.clock_watch import ClockWatch
from station.service.ending import Ending
from station.service.idle_look import IdleLook, Looker
from station.service.interlock_record import InterlockRecord
from station.service.last_run import last_run
from station.service.late_records import LateRecords
from station.service.made_here import made_here
from station.service.recording import Recording
from station.service.robot_fits import check_fits
from station.service.run import Run
from station.service.trips import Trips
from station.settings import Settings
from station.store import Store, request_hash, too_full

__all__ = ["Busy", "InputRefused", "KeyReused", "LiveEvent", "NotFound", "Orchestrator", "Submitted"]

log = logging.getLogger(__name__)

T = TypeVar("T")
IDLE_S = 0.5
SHUTDOWN_LIMIT_S = 10.0


class Orchestrator:
    """The only interface that moves the station; every method may be called from any thread."""

    def __init__(
        self,
        devices: Devices,
        store: Store,
        settings: Settings,
        kinds: Mapping[str, RunKind] = RUN_KINDS,
    ) -> None:
        self._store = store
        self._settings = settings
        self._kinds = kinds
        self._listeners = Listeners()
        self._machine = Machine(
            devices, settings.limits, self._listeners, settings.interlocks, partial(calibration_holds, store)
        )
        self._trips = Trips(self._machine, store)
        self._listeners.subscribe(InterlockRecord(store, lambda: self._run.id if self._run else None))
        self._submitting = Lock()
        self._lock = Lock()
        self._run: Run | None = None
        self._last = store.last_on_rig()
        self._clock = ClockWatch(store)
        self._finished: RunView | None = None
        if self._last is not None:
            self._machine.robot = store.robot_or_nominal(self._last.robot_serial)
            self._finished = last_run(store, self._last, self._machine.shown_place)
        self._holds = self._calibration_holds()
        self._closing = False
        self.late_records = LateRecords(store)
        self._queue: Queue[Run | IdleLook[Any] | None] = Queue()
        self._worker = Thread(target=self._work, name="orchestrator", daemon=True)
        self._worker.start()

    # Asking for runs -----------------------------------------------------------------------------

    def submit(
        self, request: CalibrationRequest, *, idempotency_key: str | None = None, by: Actor = STATION
    ) -> Submitted:
        """Start a run, or find the one that this key started.

        :raises Busy: another run holds the rig.
        :raises KeyReused: the key was used for another request.
        :raises InputRefused: the robot does not fit this station, or the station is shutting down.
        :raises NotApplicable: the offsets of the run it refers to cannot be written or rolled back.
        :raises StoreUnavailable: it cannot be recorded; nothing was started.
        """
        kind = self._kinds[request.kind]
        body_hash = request_hash(request)
        with self._submitting:
            if idempotency_key is not None:
                known = self._store.find_key(idempotency_key, body_hash)
                if known is not None:
                    return Submitted(known, created=False)
            if self._closing:
                raise InputRefused("The station is shutting down; start it again first.")
            if (holder := self._run) is not None:
                raise Busy(holder.id)
            if kind.procedure is None:
                raise InputRefused(f"{display_name('run_kinds', kind.name)} is not carried out on the rig.")
            if trouble := self.no_room():
                raise StoreUnavailable(trouble)
            robot = self._store.robot_or_nominal(request.robot_serial)
            check_fits(robot, self._settings.joints)
            measured = robot.informed(request.references)
            kind.check(self._store, request)
            uid = uid7()
            calibration_id = self._store.create(
                request,
                robot,
                key=idempotency_key,
                body_hash=body_hash,
                uid=uid,
                by=by,
                made_by=made_here(self._settings, self._machine.devices),
            )
            run = Run(calibration_id, uid, request, measured)
            with self._lock:
                self._run = run
        self._listeners.publish("run", run.brief())
        self._queue.put(run)
        return Submitted(calibration_id, created=True)

    def follow(
        self,
        kind: str,
        calibration_id: int,
        operator: str,
        *,
        idempotency_key: str | None = None,
        by: Actor = STATION,
    ) -> Submitted:
        """Start a run that refers to an earlier one: apply it, roll it back, distinguish its causes.

        If it has been done already, and repeating it would be harmless, that run is returned.

        :raises NotFound: there is no such run; otherwise as `submit`.
        """
        done_by = self._kinds[kind].done_by
        if done_by is not None and (done := done_by(self._store, calibration_id)) is not None:
            return Submitted(done, created=False)
        serial = self._store.summary(calibration_id).robot_serial
        request = CalibrationRequest(serial, kind, operator, of=calibration_id)
        return self.submit(request, idempotency_key=idempotency_key, by=by)

    def no_room(self) -> str | None:
        """Why the disk is too full for a run; None if it is not."""
        return too_full(self._store.path, self._settings.service.least_free_mb)

    def retract(self, operator: str, *, idempotency_key: str | None = None, by: Actor = STATION) -> Submitted:
        """Start a run that brings the arm back into the workspace of the robot measured last.

        :raises: as `submit`.
        """
        request = CalibrationRequest(self._machine.robot.serial, "retract", operator)
        return self.submit(request, idempotency_key=idempotency_key, by=by)

    def abort(self, calibration_id: int, who: str = "the operator") -> None:
        """End a run at once and bring the machine to standstill; harmless if repeated or after its end.

        :raises NotFound: there is no such run.
        """
        run = self._run
        if run is not None and run.id == calibration_id:
            self._halt(run, who)
        else:
            self._store.summary(calibration_id)

    @property
    def emulated(self) -> bool:
        """Whether the devices are those of the emulated rig."""
        return self._machine.devices.emulated

    @property
    def running(self) -> int | None:
        """The run that holds the rig."""
        run = self._run
        return None if run is None else run.id

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes that `stop` stops."""
        return tuple(axis.name for axis in self._machine.devices.axes)

    def clear_failed_check(self, serial: str, who: str, reason: str) -> CalibrationHolds:
        """Permit work with the calibration after a failed check.

        :raises NotFound: no such robot.
        :raises NotApplicable: nothing is locked.
        """
        clear_failed_check(self._store, serial, who, reason)
        with self._lock:
            self._holds = self._calibration_holds()
        return calibration_holds(self._store, serial)

    def _calibration_holds(self) -> CalibrationHolds:
        """Whether the calibration of the robot measured last is valid; cached for snapshots."""
        serial = self._machine.robot.serial
        try:
            self._machine.locks.look_at_reference()
            return calibration_holds(self._store, serial)
        except StoreUnavailable as error:
            return CalibrationHolds(robot_serial=serial, locked=True, text=f"Not known: {error}")

    def prompt(self, calibration_id: int) -> Prompt | None:
        """The current prompt of a run."""
        run = self._run
        return run.prompt if run is not None and run.id == calibration_id else None

    def answer(self, calibration_id: int, prompt: str, value: float | None, who: str) -> None:
        """Answer the prompt of a run.

        :raises NotFound: there is no such run.
        :raises NotApplicable: it has no prompt, or a different one.
        :raises FieldRefused: the value is missing or impossible; the run continues to wait.
        """
        run = self._run
        if run is None or run.id != calibration_id:
            self._store.summary(calibration_id)
            raise NotApplicable(f"Run {calibration_id} does not ask anything.")
        run.answer(prompt, value, who)

    def stop(self, who: str) -> dict[str, str | None]:
        """Quick stop of both axes, immediately and in any state; an active run is aborted.

        Returns, by axis, None if it confirmed the stop, otherwise the error. The answer is that of the
        drives; it is recorded afterwards.
        """
        return self._halt(self._run, who)

    def _halt(self, run: Run | None, who: str) -> dict[str, str | None]:
        if run is not None:
            run.stopped_by = run.stopped_by or who
            run.cancel.set()
        outcome = self._machine.quick_stop()
        trouble = {name: text for name, text in outcome.items() if text}
        log.warning("Stop by %s: %s", who, trouble or "both axes confirmed")
        self.late_records.stop(run.id if run else None, who, trouble)
        return outcome

    def wait(self, calibration_id: int, timeout_s: float | None = None) -> State:
        """Wait until the run has ended or the time has expired; returns its state. :raises NotFound:"""
        run = self._run
        if run is not None and run.id == calibration_id and not run.ended.wait(timeout_s):
            return run.state
        return self._store.summary(calibration_id).state

    def shutdown(self) -> None:
        """Abort the active run, make safe, end the worker, close the devices. May be repeated."""
        with self._submitting:
            first, self._closing = not self._closing, True
        if first:
            if self._run is not None:
                self._halt(self._run, "the station's shutdown")
            self._queue.put(None)
        self._worker.join(SHUTDOWN_LIMIT_S)
        if self._worker.is_alive():
            log.error("The worker hangs in a device; the run will be marked interrupted at the next start")
        self.late_records.close(SHUTDOWN_LIMIT_S)
        self._machine.close()

    # Watching ------------------------------------------------------------------------------------

    def subscribe(self, listener: Listener) -> Callable[[], None]:
        """Call a function for every event, in the worker's thread; returns that to unsubscribe."""
        return self._listeners.subscribe(listener)

    def snapshot(self) -> StationView:
        """Everything a page needs. Never waits for a device."""
        with self._lock:
            run, last, finished, holds = self._run, self._last, self._finished, self._holds
        robot = run.robot if run else self._machine.robot
        return StationView(
            station=StationInfo(
                name=self._settings.name,
                emulated=self._machine.devices.emulated,
                limits=self._settings.limits.model_dump(),
                plans=tuple(PLANS),
                recommended_plan=RECOMMENDED,
            ),
            devices=self._machine.device_views(),
            interlocks=self._machine.interlocks(),
            machine=self._machine.view(),
            workspace=Workspace(x=robot.workspace_x, y=robot.workspace_y),
            retract=self._machine.retract(),
            calibration=holds,
            run=run.view() if run else None,
            last=last,
            finished=None if run else finished,
        )

    def device_details(self) -> tuple[DeviceDetail, ...]:
        """Every device, for maintenance. Never waits for one."""
        return self._machine.device_details()

    def while_idle(self, look: Looker[T], limit_s: float) -> T:
        """The result of `look` for the devices and the robot measured last; the worker calls it between runs.

        :raises Busy: a run holds the rig.
        :raises TimeoutError: the devices do not answer in time.
        """
        if (holder := self._run) is not None:
            raise Busy(holder.id)
        asked = IdleLook(look)
        self._queue.put(asked)
        return asked.answer(limit_s)

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
            if isinstance(run, IdleLook):
                run.carry_out(self._machine.devices, self._machine.robot)
            else:
                self._execute(run)

    def _watch(self) -> None:
        try:
            self._machine.watch()
        except Exception:  # the worker must survive any error of an idle device
            log.exception("Looking at the idle machine failed")
        self._store.repeat_ends()
        self._clock.look()

    def _execute(self, run: Run) -> None:
        recording = Recording(self._machine.devices, self._settings)
        ending = self._perform(run, recording)
        failed_s = time.monotonic()
        ending = self._bring_to_rest(run, ending)
        self._trips.record(run, ending, failed_s)
        self._keep_wire(run, recording)
        judged = self._kinds[run.request.kind].judged
        run.state = self._store.finish(run.id, ending.state, ending.result, ending.reason, judged=judged)
        try:
            summary = self._store.summary(run.id)
        except StoreUnavailable as error:
            log.exception("The end of run %d cannot be read back", run.id)
            summary = run.unread(because("store_failed", text=str(error)))
        with self._lock:
            self._last, self._run, self._holds = summary, None, self._calibration_holds()
            self._finished = run.view()
        run.ended.set()
        self._listeners.publish("ended", summary)

    def _keep_wire(self, run: Run, recording: Recording) -> None:
        try:
            self._store.add_wire(run.id, recording.end())
        except StoreUnavailable:
            log.exception("The end of the wire log of run %d cannot be stored", run.id)

    def _perform(self, run: Run, recording: Recording) -> Ending:
        kind = self._kinds[run.request.kind]
        try:
            result = CarryingOut(
                run,
                kind,
                self._machine,
                self._store,
                self._settings,
                self._listeners,
                recording.begin,
                recording.take,
            ).result()
        except Cancelled:
            return Ending(State.ABORTED)
        except Unanswered as error:
            return Ending(State.ABORTED, because("prompt_expired", text=error.text, limit_s=error.limit_s))
        except (DeviceError, StepFailed, InputRefused) as error:
            tripped = self._trips.tripped(run, error)
            return Ending(State.FAILED, because("step_failed", text=str(error)), tripped=tripped)
        except StoreUnavailable as error:
            log.exception("Run %d cannot be stored", run.id)
            return Ending(State.FAILED, because("store_failed", text=str(error)))
        except Exception as error:  # the worker must survive any error in a procedure
            log.exception("Run %d failed unexpectedly", run.id)
            return Ending(State.FAILED, because("unexpected", type=type(error).__name__, text=str(error)))
        if not kind.judged:
            return Ending(State.SUCCEEDED, result.reason)
        return Ending(State.SUCCEEDED, result.reason, result)

    def _bring_to_rest(self, run: Run, ending: Ending) -> Ending:
        """In every case: standstill is confirmed, or the run reports that it was not. A late stop counts."""
        if ending.state is State.SUCCEEDED and not run.cancel.is_set():
            doubt = self._machine.standstill()
            if doubt is None:
                return ending
            ending = Ending(State.FAILED)
            self._machine.make_safe()
        else:
            doubt = self._machine.make_safe(insist=run.has_moved)
            if not run.has_moved:
                doubt = None
        if run.cancel.is_set():
            ending = Ending(State.ABORTED, because("stopped", by=run.stopped_by or "somebody"))
        return ending.without_result(doubt)
