"""Every path through the states, a fault at every step, an abort at every step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from threading import Event
from typing import Any

import pytest

from drivers.errors import DeviceFault, LinkLost
from station.errors import Busy, InputRefused, KeyReused, NotFound, StoreUnavailable
from station.five_bar.robot_file import Robot
from station.motion.events import LiveEvent
from station.records import (
    Accuracy,
    CalibrationRequest,
    MeasurementSequence,
    PlanName,
    Procedure,
    SequenceTitle,
    State,
    StationView,
)
from station.service.orchestrator import Orchestrator
from station.settings import LimitSettings, Settings
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import Start
from tests.station.fakes import STOPS, Rig, result_of, stop_at, stop_with
from tests.waiting import soon

REQUEST = asked("R1", "paper")
LIMIT_S = 10.0


def run_to_end(orchestrator: Orchestrator, request: CalibrationRequest = REQUEST) -> int:
    calibration_id = orchestrator.submit(request).id
    assert orchestrator.wait(calibration_id, LIMIT_S).ended
    return calibration_id


def outcome(store: Store, calibration_id: int) -> tuple[str, str | None, str]:
    calibration = store.calibration(calibration_id)
    return calibration.state, calibration.verdict, calibration.reason or ""


def recorded(store: Store, run: int | None) -> list[Any]:
    """The events of a run, once there are any: a stop is recorded after its answer."""
    return list(soon(lambda: store.events(run)))


def until(orchestrator: Orchestrator, condition: Callable[[StationView], bool]) -> StationView:
    """The first snapshot that meets the condition."""

    def met() -> StationView | None:
        return snapshot if condition(snapshot := orchestrator.snapshot()) else None

    return soon(met)


def measuring(snapshot: StationView) -> bool:
    """A run has begun a measurement sequence."""
    return snapshot.run is not None and snapshot.run.walk is not None


# The whole way -----------------------------------------------------------------------------------


def test_a_run_walks_reads_stores_and_succeeds(start: Start, store: Store, rig: Rig) -> None:
    orchestrator = start()
    events: list[LiveEvent] = []
    orchestrator.subscribe(events.append)
    run = run_to_end(orchestrator)
    assert outcome(store, run) == (
        "succeeded",
        "pass",
        "Converged in 2 passes; the compensation accuracy is 0.0100°.",
    )
    readings = store.readings(run)
    assert [(r.reading, r.sequence, r.position) for r in readings] == [
        (1, 1, "p1"),
        (2, 1, "p2"),
        (3, 1, "p3"),
        (4, 2, "p1"),
        (5, 2, "p2"),
        (6, 2, "p3"),
    ]
    for reading, stop in zip(readings, STOPS * 2, strict=True):
        assert reading.theta_deg == pytest.approx(stop.theta_deg)
        assert all(w in (0, got) for w, got in zip(stop.approach, reading.approach, strict=True))
        assert len(reading.samples_mm) == 2
    assert [r.t_s for r in readings] == sorted(r.t_s for r in readings)
    kinds = [event.type for event in events]
    assert kinds.count("walk") == 2
    assert kinds.count("reading") == 6
    assert kinds.count("residuals") == 1
    assert kinds[-1] == "ended"
    calibration = store.calibration(run)
    assert (calibration.step, calibration.steps) == (6, 6)
    assert "axis 1 quick_stop" not in rig.script.calls


def test_a_reading_is_stored_before_the_next_move(start: Start, store: Store, rig: Rig) -> None:
    stored: list[int] = []
    orchestrator = start()
    rig.script.do("axis 1 move_to", lambda: stored.append(len(store.readings(1))))
    run_to_end(orchestrator)
    moves_per_stop = [stored.count(n) for n in range(6)]
    assert min(moves_per_stop) >= 1
    assert stored == sorted(stored)


def test_a_wanted_approach_gets_a_run_up(start: Start, store: Store) -> None:
    def both_sides(plan: PlanName, robot: Robot) -> Procedure:
        up, down = stop_at("p", 0, -700, (1, 1)), stop_at("p", 0, -700, (-1, -1))
        readings = yield MeasurementSequence("Both sides", 1, (up, down, up, down))
        return result_of(readings)

    run = run_to_end(start(both_sides))
    assert [r.approach for r in store.readings(run)] == [(1, 1), (-1, -1), (1, 1), (-1, -1)]


def test_a_way_too_short_to_take_up_play_gets_a_run_up(start: Start, store: Store, rig: Rig) -> None:
    """Joint 2 moves by a hundredth of a degree: no approach is wanted, but the recorded one must be true."""
    first, second = stop_with("p", (-7.0, 190.0), (-1, -1)), stop_with("q", (20.0, 190.009))

    def near(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Near", 1, (first, second))
        return result_of(readings)

    run = run_to_end(start(near))
    moves = rig.script.calls.count("axis 2 move_to")
    assert moves == 4, "both stops have a run-up"
    assert store.readings(run)[-1].approach == (1, 1)


def test_a_failed_verdict_is_a_run_that_succeeded(start: Start, store: Store) -> None:
    def fails(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Measuring", 1, STOPS)
        return result_of(readings, "fail")

    assert outcome(store, run_to_end(start(fails))) == (
        "succeeded",
        "fail",
        "The compensation did not settle: its accuracy was not better than 0.1° after 8 passes.",
    )


def test_a_pass_over_nan_fails_closed(start: Start, store: Store) -> None:
    def nan(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Measuring", 1, STOPS)
        return result_of(readings).model_copy(update={"after": Accuracy(reading_rms_mm=float("nan"))})

    state, verdict, reason = outcome(store, run_to_end(start(nan)))
    assert (state, verdict) == ("failed", "fail")
    assert "after.reading_rms_mm" in reason


# Faults ------------------------------------------------------------------------------------------

FAULTS = [
    ("axis 1 connect", 1, "failed"),
    ("scale connect", 1, "failed"),
    ("axis 2 enable", 1, "failed"),
    ("axis 1 status", 1, "failed"),
    ("axis 1 move_to", 1, "failed"),
    ("axis 2 move_to", 3, "failed"),
    ("axis 2 status", 4, "failed"),
    ("axis 1 feedback", 1, "failed"),
    ("axis 2 feedback", 5, "failed"),
    ("scale read", 1, "failed"),
    ("scale read", 4, "failed"),
]


@pytest.mark.parametrize(("call", "at", "state"), FAULTS)
@pytest.mark.parametrize("error", [LinkLost("nothing answers"), DeviceFault("it shows a fault")])
def test_a_device_fault_at_any_step_stops_both_axes_and_says_why(
    start: Start,
    store: Store,
    rig: Rig,
    call: str,
    at: int,
    state: str,
    error: Exception,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("station.motion.machine.STANDSTILL_LIMIT_S", 0.1)
    rig.script.fail(call, error, at=at)
    orchestrator = start()
    run = run_to_end(orchestrator)
    got, verdict, reason = outcome(store, run)
    assert (got, verdict) == (state, None)
    assert str(error) in reason
    assert {"axis 1 quick_stop", "axis 2 quick_stop", "scale make_safe"} <= set(rig.script.calls)
    device = next(d for d in orchestrator.snapshot().devices if d.name == call.rsplit(" ", 1)[0])
    assert device.state in ("lost", "fault", "ok")
    rig.script.faults.clear()
    assert outcome(store, run_to_end(orchestrator))[0] == "succeeded", "the way back"


def test_a_stop_is_sent_again_until_it_is_confirmed(start: Start, store: Store, rig: Rig) -> None:
    lost = LinkLost("nothing answers")
    refused = iter([lost, lost])

    def lost_in_motion() -> None:
        rig.axes[0].moving = True
        raise lost

    rig.script.do("axis 1 feedback", lost_in_motion, at=4)

    def twice() -> None:
        if error := next(refused, None):
            raise error

    rig.script.do("axis 1 quick_stop", twice)
    _, _, reason = outcome(store, run_to_end(start()))
    assert reason == "At position p1: nothing answers"
    assert rig.script.calls.count("axis 1 quick_stop") == 3
    assert rig.script.calls.count("axis 2 quick_stop") == 1


def test_all_devices_that_do_not_connect_are_named_at_once(start: Start, store: Store, rig: Rig) -> None:
    rig.script.fail("scale connect", LinkLost("Scale: cable?"))
    rig.script.fail("axis 2 connect", LinkLost("Axis 2: power?"))
    _, _, reason = outcome(store, run_to_end(start()))
    assert "Scale: cable?" in reason
    assert "Axis 2: power?" in reason


def test_a_store_that_takes_nothing_more_fails_the_run_and_stops_the_machine(
    start: Start, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise StoreUnavailable("database or disk is full")

    monkeypatch.setattr(store, "add_reading", full)
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "disk is full" in reason
    assert "axis 1 quick_stop" in rig.script.calls


def test_a_mistake_in_a_procedure_is_a_failed_run(start: Start, store: Store, rig: Rig) -> None:
    def broken(plan: PlanName, robot: Robot) -> Procedure:
        yield MeasurementSequence("Measuring", 1, STOPS)
        raise ZeroDivisionError("singular")

    state, _, reason = outcome(store, run_to_end(start(broken)))
    assert state == "failed"
    assert "unexpected error" in reason and "ZeroDivisionError" not in reason  # that is in the log
    assert "axis 2 quick_stop" in rig.script.calls


# Alarms, limits, doubtful readings ---------------------------------------------------------------


def test_an_alarm_on_the_way_is_named_and_reset_by_the_next_run(start: Start, store: Store, rig: Rig) -> None:
    def alarm() -> None:
        rig.axes[1].alarm = 0x180
        del rig.script.faults["axis 2 move_to"]

    orchestrator = start()
    rig.script.do("axis 2 move_to", alarm, at=2)
    state, _, reason = outcome(store, run_to_end(orchestrator))
    assert state == "failed"
    assert "Axis 2 shows alarm 180h" in reason
    lock = next(lock for lock in orchestrator.snapshot().interlocks if lock.id == "drives")
    assert not lock.ok
    assert outcome(store, run_to_end(orchestrator))[0] == "succeeded"
    assert "axis 2 reset_alarm" in rig.script.calls


def test_an_axis_that_has_arrived_is_watched_until_the_other_has_too(
    start: Start, store: Store, rig: Rig
) -> None:
    def alarm() -> None:
        rig.axes[0].alarm = 0x150

    rig.axes[1].stuck = True
    rig.script.do("axis 2 status", alarm, at=4)
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "Axis 1 shows alarm 150h" in reason


def test_an_alarm_that_stays_is_a_failure_without_motion(start: Start, store: Store, rig: Rig) -> None:
    rig.axes[0].alarm, rig.axes[0].alarm_resettable = 0x210, False
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "210" in reason
    assert "axis 1 move_to" not in rig.script.calls


def test_a_drive_that_loses_its_power_on_the_way_fails_the_run(start: Start, store: Store, rig: Rig) -> None:
    def off() -> None:
        rig.axes[0].enabled = False

    rig.script.do("axis 1 move_to", off, at=3)
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "Axis 1 lost its power" in reason


def one(stop: Any) -> Any:
    def procedure(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("One", 1, (stop,))
        return result_of(readings)

    return procedure


@pytest.mark.parametrize(
    ("stop", "why"),
    [
        (stop_at("far", 0, -800), "18.0 mm outside"),
        (replace(STOPS[0], theta_deg=(90.0, 180.0)), "joint 1 would go to 90.000 deg"),
        (replace(STOPS[0], theta_deg=(float("nan"), 180.0)), "joint 1 would go to nan deg"),
        (replace(STOPS[0], theta_deg=(-50.0, 230.0)), "The way to position p1 is refused"),
    ],
)
def test_a_stop_outside_the_limits_is_refused_before_any_motion(
    start: Start, store: Store, rig: Rig, stop: Any, why: str
) -> None:
    state, _, reason = outcome(store, run_to_end(start(one(stop))))
    assert state == "failed"
    assert why in reason
    assert "axis 1 move_to" not in rig.script.calls


def test_an_arm_far_outside_its_workspace_does_not_start(start: Start, store: Store, rig: Rig) -> None:
    rig.axes[0].theta_deg, rig.axes[1].theta_deg = -50.0, 230.0
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "The arm stands within its workspace" in reason


def test_a_joint_that_does_not_arrive_is_named(
    start: Start, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.motion.positioner._ARRIVAL_MARGIN_S", 0.05)
    rig.axes[1].stuck = True
    settings = Settings(limits=LimitSettings(speed_deg_s=180, settle_s=0, samples=2))
    state, _, reason = outcome(store, run_to_end(start(settings=settings)))
    assert state == "failed"
    assert "Axis 2 did not reach position p1" in reason


def test_a_joint_that_leaves_its_way_is_stopped(
    start: Start, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.motion.positioner._LOOK_S", 0.0)

    def runaway() -> None:
        rig.axes[0].theta_deg += 5.0

    rig.axes[0].stuck = rig.axes[1].stuck = True
    rig.script.do("axis 1 status", runaway, at=2)
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "Joint 1 left its way" in reason


def test_feedback_away_from_the_command_is_not_measured(start: Start, store: Store, rig: Rig) -> None:
    def lag() -> None:
        rig.axes[0].theta_deg += 0.2

    rig.script.do("axis 1 feedback", lag, at=2)
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "joint 1 stands at" in reason
    assert store.readings(1) == []


def test_samples_that_disagree_once_are_read_again(start: Start, store: Store, rig: Rig) -> None:
    noise = iter([0.0, 0.0, 1.0])
    rig.scale.noise_mm = lambda: next(noise, 0.0)
    assert outcome(store, run_to_end(start()))[0] == "succeeded"


def test_samples_that_disagree_twice_name_the_reading(start: Start, store: Store, rig: Rig) -> None:
    rig.scale.noise_mm = lambda: float(rig.script.calls.count("scale read"))
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "Reading 1 at position p1 does not settle" in reason


def test_a_sample_that_is_not_a_number_is_not_stored(start: Start, store: Store, rig: Rig) -> None:
    rig.scale.noise_mm = lambda: float("nan") if rig.script.calls.count("scale read") > 6 else 0.0
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "is not a number" in reason


def test_a_rod_that_slips_is_noticed(start: Start, store: Store, rig: Rig) -> None:
    rig.scale.noise_mm = lambda: 80.0 if len(rig.script.calls) and store.readings(1) else 0.0
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "Reading 2 at position p2 is implausible: the scale moved +80.0 mm" in reason


# Stop and abort ----------------------------------------------------------------------------------

STEPS = [
    ("axis 1 connect", 1),
    ("axis 2 enable", 1),
    ("axis 1 move_to", 1),
    ("axis 2 move_to", 2),
    ("axis 1 status", 2),
    ("axis 2 status", 6),
    ("axis 2 feedback", 3),
    ("scale read", 2),
    ("scale read", 13),
]


@pytest.mark.parametrize(("call", "at"), STEPS)
def test_an_abort_at_any_step_ends_in_standstill_and_is_stored(
    start: Start, store: Store, rig: Rig, call: str, at: int
) -> None:
    orchestrator = start()
    pressed = Event()

    def press() -> None:
        if not pressed.is_set():
            pressed.set()
            orchestrator.abort(1, "ada")

    rig.script.do(call, press, at=at)
    run = run_to_end(orchestrator)
    assert outcome(store, run) == ("aborted", None, "Stopped by ada.")
    calls = rig.script.calls
    stopped = len(calls) - 1 - calls[::-1].index("axis 1 quick_stop")
    assert "axis 1 move_to" not in calls[stopped:]
    assert "axis 2 move_to" not in calls[stopped:]
    assert [(e.kind, e.data["by"]) for e in recorded(store, run)] == [("stop", "ada")]
    orchestrator.abort(run)
    orchestrator.abort(run)
    assert store.calibration(run).state == "aborted"
    assert outcome(store, run_to_end(orchestrator))[0] == "succeeded", "the way back"


def test_an_abort_during_the_last_computation_wins_over_the_result(
    start: Start, store: Store, rig: Rig
) -> None:
    started: list[Orchestrator] = []

    def slow(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Measuring", 1, STOPS)
        started[0].stop("ada")
        return result_of(readings)

    orchestrator = start(slow)
    started.append(orchestrator)
    assert outcome(store, run_to_end(orchestrator)) == ("aborted", None, "Stopped by ada.")


def test_two_aborts_at_once_are_one(start: Start, store: Store, rig: Rig) -> None:
    orchestrator = start()

    def press() -> None:
        rig.script.faults.clear()
        orchestrator.abort(1, "ada")
        orchestrator.abort(1, "bob")

    rig.script.do("scale read", press, at=3)
    run = run_to_end(orchestrator)
    assert outcome(store, run) == ("aborted", None, "Stopped by ada.")


@pytest.mark.parametrize("hanging", ["axis 1", "axis 2", "scale"])
def test_a_device_that_hangs_does_not_keep_the_others_from_being_stopped(
    start: Start, store: Store, rig: Rig, hanging: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.motion.machine.STOP_LIMIT_S", 0.2)
    orchestrator = start()
    reached, ended = Event(), Event()

    def hang() -> None:
        reached.set()
        rig.released.wait(LIMIT_S)
        ended.set()

    call = "scale read" if hanging == "scale" else f"{hanging} feedback"
    rig.script.do(call, hang, at=4)
    if hanging != "scale":
        rig.script.do(f"{hanging} quick_stop", hang)
    run = orchestrator.submit(REQUEST).id
    assert reached.wait(LIMIT_S)
    orchestrator.stop("ada")
    assert not ended.is_set(), "the stop did not wait for the device that hangs"
    stopped = {call for call in rig.script.calls if call.endswith("quick_stop")}
    assert stopped == {"axis 1 quick_stop", "axis 2 quick_stop"}
    view = orchestrator.snapshot().run
    assert view is not None and view.id == run, "snapshots do not wait for a device"
    events = recorded(store, run)
    if hanging != "scale":
        assert events[0].data[hanging] == "no answer within 0.2 s"
    rig.released.set()
    assert orchestrator.wait(run, LIMIT_S) is State.ABORTED


def test_a_standstill_that_is_not_seen_is_said(
    start: Start, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.motion.machine.STANDSTILL_LIMIT_S", 0.2)
    orchestrator = start()
    rig.axes[0].stuck = True
    rig.script.do("axis 1 quick_stop", lambda: rig.script.do("axis 1 status", coast))

    def coast() -> None:
        rig.axes[0].moving = True

    run = orchestrator.submit(REQUEST).id
    until(orchestrator, measuring)
    orchestrator.abort(run, "ada")
    assert orchestrator.wait(run, LIMIT_S) is State.ABORTED
    assert store.calibration(run).reason == (
        "Stopped by ada. Standstill could not be confirmed, look at the arm (axis 1: still moves)."
    )


def test_a_success_that_does_not_come_to_rest_is_a_failure(
    start: Start, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.motion.machine.STANDSTILL_LIMIT_S", 0.1)

    def creeping(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Measuring", 1, STOPS)
        rig.axes[1].moving = True
        return result_of(readings)

    state, verdict, reason = outcome(store, run_to_end(start(creeping)))
    assert (state, verdict) == ("failed", None)
    assert "axis 2: still moves" in reason
    assert "axis 2 quick_stop" in rig.script.calls


def test_stop_without_a_run_stops_too(
    start: Start, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.service.orchestrator.IDLE_S", 0.01)
    orchestrator = start()
    until(orchestrator, lambda snapshot: snapshot.machine is not None)
    assert orchestrator.stop("ada") == {"axis 1": None, "axis 2": None}
    assert {"axis 1 quick_stop", "axis 2 quick_stop"} <= set(rig.script.calls)
    assert [event.data for event in recorded(store, None)] == [{"by": "ada"}]


def test_a_stop_that_no_drive_confirmed_says_so(start: Start, store: Store) -> None:
    assert start().stop("ada")["axis 2"] == "axis 2 is not connected"
    assert recorded(store, None)[0].data["axis 2"] == "axis 2 is not connected"


def test_aborting_what_does_not_exist_is_said(start: Start) -> None:
    with pytest.raises(NotFound):
        start().abort(7)


def test_shutdown_during_a_run_aborts_it_and_closes_the_devices(start: Start, store: Store, rig: Rig) -> None:
    orchestrator = start()
    rig.axes[0].stuck = True
    run = orchestrator.submit(REQUEST).id
    until(orchestrator, measuring)
    orchestrator.shutdown()
    orchestrator.shutdown()
    assert outcome(store, run) == ("aborted", None, "Stopped by the station's shutdown.")
    assert {"axis 1 close", "axis 2 close", "scale close"} <= set(rig.script.calls)
    with pytest.raises(InputRefused, match="shutting down"):
        orchestrator.submit(REQUEST)


# Asking ------------------------------------------------------------------------------------------


def test_a_second_run_is_refused_while_one_holds_the_rig(start: Start, rig: Rig) -> None:
    orchestrator = start()
    rig.axes[0].stuck = True
    first = orchestrator.submit(REQUEST, idempotency_key="k")
    with pytest.raises(Busy) as busy:
        orchestrator.submit(REQUEST)
    assert busy.value.calibration_id == first.id
    again = orchestrator.submit(REQUEST, idempotency_key="k")
    assert (again.id, again.created) == (first.id, False)


def test_a_key_outlives_the_run_and_the_process(start: Start) -> None:
    first = start()
    run = first.submit(REQUEST, idempotency_key="k").id
    first.wait(run, LIMIT_S)
    first.shutdown()
    second = start()
    assert second.submit(REQUEST, idempotency_key="k").id == run
    with pytest.raises(KeyReused):
        second.submit(replace(REQUEST, operator="bob"), idempotency_key="k")


def test_a_robot_that_does_not_fit_the_drives_is_refused(start: Start, store: Store) -> None:
    store.save_robot(replace(Robot.default("R1"), ratio=25.0))
    with pytest.raises(InputRefused, match=r"joint 1 has ratio 25\.0 instead of 20\.0"):
        start().submit(REQUEST)
    assert store.calibrations().items == []


# Watching ----------------------------------------------------------------------------------------


def test_the_snapshot_tells_the_run_reading_by_reading(start: Start, rig: Rig) -> None:
    orchestrator = start()
    seen: list[StationView] = []

    def look(event: LiveEvent) -> None:
        if event.type == "reading":
            seen.append(orchestrator.snapshot())

    orchestrator.subscribe(look)
    run_to_end(orchestrator)
    third = seen[2].run
    assert third is not None
    assert [stop.done for stop in third.stops] == [True, True, True]
    assert [row.reading for row in third.readings] == [1, 2, 3]
    assert third.readings[0].x_mm == pytest.approx(-200.0)
    assert third.walk == SequenceTitle(number=1, title="Measuring, pass 1")
    assert (third.step, third.steps) == (3, 3)
    assert third.remaining_s == 0
    assert all(lock.ok for lock in seen[2].interlocks)
    after = orchestrator.snapshot()
    assert after.run is None
    assert after.last is not None and after.last.verdict == "pass"


def test_a_listener_that_fails_does_not_disturb_the_run(start: Start, store: Store) -> None:
    orchestrator = start()

    def broken(event: LiveEvent) -> None:
        raise RuntimeError("the page is gone")

    orchestrator.subscribe(broken)
    assert outcome(store, run_to_end(orchestrator))[0] == "succeeded"


def test_an_idle_station_watches_its_machine_and_gets_lost_devices_back(
    start: Start, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.service.orchestrator.IDLE_S", 0.02)
    rig.script.fail("scale read", LinkLost("cable?"))
    orchestrator = start()
    events: list[LiveEvent] = []
    orchestrator.subscribe(events.append)
    lost = until(orchestrator, lambda s: s.devices[0].state == "lost")
    assert lost.devices[0].text == "cable?"
    assert lost.machine is None
    assert not lost.interlocks[0].ok
    rig.script.faults.clear()
    found = until(orchestrator, lambda s: s.machine is not None)
    assert found.machine is not None and found.machine.theta2_deg == 180.0
    assert all(lock.ok for lock in found.interlocks)
    assert {"device", "interlock", "machine"} <= {event.type for event in events}

    def told() -> list[Any]:
        return [event.data for event in events if event.type == "interlock"]

    until(orchestrator, lambda s: told()[-1] == s.interlocks)
    assert all(before != after for before, after in pairwise(told()))


def test_a_readout_that_froze_is_named_at_the_next_reading(start: Start, store: Store, rig: Rig) -> None:
    frozen: list[float] = []

    def freeze() -> None:
        frozen.append(rig.scale.offset_mm)
        rig.scale.noise_mm = lambda: 12.5 - true_mm()

    def true_mm() -> float:
        noise, rig.scale.noise_mm = rig.scale.noise_mm, lambda: 0.0
        rig.script.faults.clear()
        value = rig.scale.read_mm()
        rig.scale.noise_mm = noise
        return value

    rig.script.do("axis 1 move_to", freeze, at=1)
    state, _, reason = outcome(store, run_to_end(start()))
    assert state == "failed"
    assert "Reading 2 at position p2 is implausible: the scale shows 12.5000 mm as before" in reason
