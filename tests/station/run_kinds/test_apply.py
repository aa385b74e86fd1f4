"""Zero offsets written to the drives, verified, rolled back: on fake drives, through every fault."""

from __future__ import annotations

import math
import sqlite3
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from drivers.errors import DeviceFault, LinkLost
from station.errors import Busy, NotApplicable, NotFound
from station.five_bar.robot_file import Robot
from station.identification.verification import Verification
from station.records import Application, Measurements, PlanName, Procedure, State
from station.run_kinds.zero_state import application
from station.service.orchestrator import Orchestrator
from station.store.store import Store
from tests.station.asking import asked, start_procedure
from tests.station.conftest import SETTINGS, Start
from tests.station.fakes import HOME_DEG, Rig, result_of, two_sequences

LIMIT_S = 20.0
OFFSETS = (0.8, -0.6)
ROBOT = replace(Robot.default("R1"), drm=(0.0, 0.0), feedback_sd_deg=0.0005)
PULSE = ROBOT.pulse_deg


@pytest.fixture
def station(start: Start, store: Store, rig: Rig) -> Orchestrator:
    """A robot with zero offsets, on the real procedures."""
    store.save_robot(ROBOT)
    for axis, offset in zip(rig.axes, OFFSETS, strict=True):
        axis.offset_deg = offset
    # the same at the same place, so that no verdict hangs on chance
    rig.scale.noise_mm = lambda: 0.0003 * math.sin(1e4 * sum(axis.theta_deg for axis in rig.axes))
    return start(start_procedure)


def ended(orchestrator: Orchestrator, run: int) -> State:
    return orchestrator.wait(run, LIMIT_S)


def calibrate(orchestrator: Orchestrator, plan: PlanName = "rapid") -> int:
    run = orchestrator.submit(asked("R1", plan)).id
    assert ended(orchestrator, run) is State.SUCCEEDED
    return run


def apply(orchestrator: Orchestrator, calibration: int) -> int:
    run = orchestrator.follow("apply", calibration, "ada").id
    assert ended(orchestrator, run).ended
    return run


def roll_back(orchestrator: Orchestrator, calibration: int) -> int:
    run = orchestrator.follow("rollback", calibration, "ada").id
    assert ended(orchestrator, run).ended
    return run


def known(store: Store, calibration: int) -> Application:
    found = application(store, store.calibration(calibration))
    assert found is not None
    return found


def offsets(rig: Rig) -> list[float]:
    return [axis.offset_deg for axis in rig.axes]


@pytest.mark.parametrize("plan", ["paper", "rapid"])
def test_applied_offsets_are_gone_and_come_back(
    plan: PlanName, station: Orchestrator, store: Store, rig: Rig
) -> None:
    calibration = calibrate(station, plan)
    assert known(store, calibration).state == "unwritten"
    run = apply(station, calibration)
    outcome = store.calibration(run)
    assert (outcome.reason or "").startswith("Verified: fresh readings agree within")
    assert (outcome.state, outcome.verdict, outcome.plan) == ("succeeded", "pass", "apply")
    assert outcome.of == calibration
    assert [r.sequence for r in store.readings(run)] == [1] * 4 + [3] * 8
    assert (known(store, calibration).state, known(store, calibration).verified) == ("applied", True)
    assert offsets(rig) == pytest.approx([0.0, 0.0], abs=0.05)
    after = store.calibration(calibrate(station, plan))
    for zero, offset in zip(after.zero_offsets, offsets(rig), strict=True):
        assert zero.value_deg == pytest.approx(offset, abs=3 * (zero.sd_deg or 0.0) + 1e-3)
    back = store.calibration(roll_back(station, calibration))
    assert (back.verdict, back.reason) == ("pass", "The old zero offsets are in the drives.")
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)
    assert known(store, calibration).state == "rolled back"


def test_what_the_servo_stands_beside_its_command_is_accounted_for(
    station: Orchestrator, store: Store, rig: Rig
) -> None:
    for axis, pulses in zip(rig.axes, (3, -4), strict=True):
        axis.stands_off_deg = pulses * PULSE
    calibration = calibrate(station)
    apply(station, calibration)
    for joint, axis in zip(known(store, calibration).joints, rig.axes, strict=True):
        assert joint.shift_deg == pytest.approx(axis.offset_deg - OFFSETS[joint.joint - 1])
    roll_back(station, calibration)
    for joint, axis in zip(known(store, calibration).joints, rig.axes, strict=True):
        assert joint.shift_deg == pytest.approx(axis.offset_deg - OFFSETS[joint.joint - 1])
        assert abs(joint.shift_deg or 0.0) < 9 * PULSE


def test_only_a_pass_is_applied_and_only_once(station: Orchestrator, store: Store, rig: Rig) -> None:
    failed = store.create(asked("R1", "paper"), ROBOT)
    store.finish(failed, State.SUCCEEDED, result_of([], "fail"))
    aborted = store.create(asked("R1", "paper"), ROBOT)
    store.finish(aborted, State.ABORTED)
    for run in (failed, aborted):
        with pytest.raises(NotApplicable, match="has not passed"):
            station.follow("apply", run, "ada")
        assert application(store, store.calibration(run)) is None
    with pytest.raises(NotFound):
        station.follow("apply", 99, "ada")
    calibration = calibrate(station)
    with pytest.raises(NotApplicable, match="nothing to roll back"):
        station.follow("rollback", calibration, "ada")
    run = apply(station, calibration)
    with pytest.raises(NotApplicable, match=f"has been applied by run {run}"):
        station.follow("apply", calibration, "ada")
    with pytest.raises(NotApplicable, match=f"it belongs to run {calibration}"):
        station.follow("apply", run, "ada")


def test_the_same_key_applies_once(station: Orchestrator) -> None:
    calibration = calibrate(station)
    first = station.follow("apply", calibration, "ada", idempotency_key="k")
    assert ended(station, first.id).ended
    again = station.follow("apply", calibration, "ada", idempotency_key="k")
    assert (again.id, again.created) == (first.id, False)


def test_while_another_run_holds_the_rig_nothing_is_applied(station: Orchestrator, rig: Rig) -> None:
    calibration = calibrate(station)
    rig.axes[0].stuck = True
    running = station.submit(asked("R1", "paper")).id
    with pytest.raises(Busy):
        station.follow("apply", calibration, "ada")
    station.abort(running)
    assert ended(station, running) is State.ABORTED


def test_rolling_back_twice_answers_the_same_run(station: Orchestrator, store: Store, rig: Rig) -> None:
    calibration = calibrate(station)
    apply(station, calibration)
    run = roll_back(station, calibration)
    again = station.follow("rollback", calibration, "bob")
    assert (again.id, again.created) == (run, False)
    with pytest.raises(NotApplicable, match="calibrate to apply again"):
        station.follow("apply", calibration, "ada")


def test_zeros_of_a_newer_run_stand_in_the_way(station: Orchestrator, store: Store) -> None:
    first, second = calibrate(station), calibrate(station)
    run = apply(station, second)
    for refused in ("apply", "rollback"):
        with pytest.raises(NotApplicable, match=f"changed since, by run {run}"):
            station.follow(refused, first, "ada")
    assert known(store, first).state == "superseded"
    third = calibrate(station)
    newest = apply(station, third)
    with pytest.raises(NotApplicable, match=f"changed since, by run {newest}"):
        station.follow("rollback", second, "ada")


def test_a_changed_robot_file_stands_in_the_way(station: Orchestrator, store: Store) -> None:
    calibration = calibrate(station)
    store.save_robot(replace(ROBOT, L=(375.2, 375.0)))
    with pytest.raises(NotApplicable, match="file of robot R1 has changed"):
        station.follow("apply", calibration, "ada")


def test_a_machine_that_changed_since_is_noticed_before_anything_is_written(
    station: Orchestrator, store: Store, rig: Rig
) -> None:
    calibration = calibrate(station)
    rig.axes[1].offset_deg += 0.1
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.state, outcome.verdict) == ("failed", None)
    assert (outcome.reason or "").startswith("Nothing was written: the machine is not as run 1 measured it")
    assert known(store, calibration).state == "unwritten"
    rig.axes[1].offset_deg -= 0.1
    assert store.calibration(apply(station, calibration)).verdict == "pass"
    rig.axes[0].offset_deg += 0.1
    outcome = store.calibration(roll_back(station, calibration))
    assert (outcome.reason or "").startswith("Nothing was written: the drives are not as they were left")
    assert known(store, calibration).state == "applied"


def test_the_readout_may_have_been_switched_off_since(station: Orchestrator, store: Store, rig: Rig) -> None:
    calibration = calibrate(station)
    rig.scale.offset_mm -= 123.0
    assert store.calibration(apply(station, calibration)).verdict == "pass"


def slip(rig: Rig, joint: int) -> Callable[[], None]:
    def slips() -> None:
        rig.axes[joint].offset_deg += 0.2
        rig.script.faults.clear()

    return slips


def test_a_verification_that_fails_rolls_back_by_itself(
    station: Orchestrator, store: Store, rig: Rig
) -> None:
    calibration = calibrate(station)
    rig.script.do("axis 2 preset", slip(rig, 0))
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.state, outcome.verdict) == ("succeeded", "fail")
    assert "Fresh readings are not predicted" in (outcome.reason or "")
    assert (outcome.reason or "").endswith("Rolled back; the old zero offsets are in the drives.")
    assert known(store, calibration).state == "rolled back"
    assert rig.axes[1].offset_deg == pytest.approx(OFFSETS[1], abs=1e-6)


FAULTS = [
    ("axis 1 preset", DeviceFault("the drive refuses its zero")),
    ("axis 2 preset", DeviceFault("the drive refuses its zero")),
    ("axis 2 preset", LinkLost("nothing answers")),
]


@pytest.mark.parametrize(("call", "error"), FAULTS)
def test_a_zero_that_is_refused_takes_the_other_one_back(
    station: Orchestrator, store: Store, rig: Rig, call: str, error: Exception
) -> None:
    calibration = calibrate(station)

    def once() -> None:
        rig.script.faults.clear()
        raise error

    rig.script.do(call, once)
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.state, outcome.verdict) == ("failed", None)
    assert outcome.reason == f"{error} The old zero offsets are in the drives."
    assert known(store, calibration).state in ("unwritten", "rolled back")
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)


def test_a_zero_that_reads_back_different_is_taken_back(
    station: Orchestrator, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibration = calibrate(station)
    axis, declare = rig.axes[1], rig.axes[1].preset

    def beside(theta_deg: float) -> None:
        declare(theta_deg + 5 * PULSE)
        monkeypatch.undo()

    monkeypatch.setattr(axis, "preset", beside)
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.reason or "").startswith("The zero of joint 2 reads back 180.0090 deg instead of 180.")
    assert known(store, calibration).state == "rolled back"
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)


def test_a_way_back_that_fails_says_so_and_can_be_pressed_again(
    station: Orchestrator, store: Store, rig: Rig
) -> None:
    calibration = calibrate(station)
    rig.script.fail("axis 2 preset", DeviceFault("the drive refuses its zero"))
    rig.script.do("axis 1 preset", lambda: rig.script.fail("axis 1 preset", DeviceFault("and this one too")))
    outcome = store.calibration(apply(station, calibration))
    assert outcome.reason == "the drive refuses its zero The way back failed too: and this one too"
    assert known(store, calibration).state == "partly"
    rig.script.faults.clear()
    assert store.calibration(roll_back(station, calibration)).verdict == "pass"
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)


def test_a_fault_on_the_verifying_walk_rolls_back(station: Orchestrator, store: Store, rig: Rig) -> None:
    calibration = calibrate(station)

    def once() -> None:
        rig.script.faults.clear()
        raise LinkLost("nothing answers")

    rig.script.do(
        "axis 2 preset",
        lambda: rig.script.do("scale read", once, at=rig.script.calls.count("scale read") + 3),
    )
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.reason or "").startswith("At position V")
    assert (outcome.reason or "").endswith("The old zero offsets are in the drives.")
    assert known(store, calibration).state == "rolled back"
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)


@pytest.mark.parametrize(("joint", "state"), [(1, "partly"), (2, "applied")])
def test_a_stop_between_the_zeros_leaves_what_is_written_and_says_so(
    station: Orchestrator, store: Store, rig: Rig, joint: int, state: str
) -> None:
    calibration = calibrate(station)

    def pressed() -> None:
        station.stop("ada")

    rig.script.do(f"axis {joint} preset", pressed)
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.state, outcome.reason) == ("aborted", "Stopped by ada.")
    found = known(store, calibration)
    assert (found.state, found.verified) == (state, False)
    assert found.joints[0].state == "applied"
    rig.script.faults.clear()
    assert store.calibration(roll_back(station, calibration)).verdict == "pass"
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)


@pytest.mark.parametrize("taken", [True, False])
def test_a_power_cut_during_a_write_is_settled_by_where_the_joints_stand(
    station: Orchestrator, start: Start, store: Store, rig: Rig, taken: bool
) -> None:
    calibration = calibrate(station)
    station.shutdown()
    run = store.create(asked("R1", "apply", of=calibration), ROBOT)
    rig.axes[0].theta_deg = HOME_DEG[0] - OFFSETS[0]
    store.begin_zero_write(run, 1, OFFSETS[0], rig.axes[0].theta_deg)
    if taken:
        rig.axes[0].connect()
        rig.axes[0].preset(HOME_DEG[0])
    store.interrupt_unfinished()
    assert known(store, calibration).state == "in doubt"
    run = roll_back(start(start_procedure), calibration)
    assert store.calibration(run).verdict == "pass"
    assert known(store, calibration).state == ("rolled back" if taken else "unwritten")
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)


def test_joints_that_were_moved_after_a_power_cut_leave_it_in_doubt(
    station: Orchestrator, store: Store, rig: Rig
) -> None:
    calibration = calibrate(station)
    run = store.create(asked("R1", "apply", of=calibration), ROBOT)
    store.begin_zero_write(run, 1, OFFSETS[0], -OFFSETS[0])
    rig.axes[0].theta_deg = 5.0
    store.interrupt_unfinished()
    outcome = store.calibration(roll_back(station, calibration))
    assert outcome.reason == (
        f"Whether joint 1 took the zero of run {run} cannot be told any more; calibrate again."
    )
    assert known(store, calibration).state == "in doubt"


def test_memory_outlives_an_application(station: Orchestrator, store: Store) -> None:
    calibration = calibrate(station)
    apply(station, calibration)
    memory = store.memory("R1")
    assert memory is not None
    assert memory.calibration_id == calibration


def test_a_robot_that_never_passed_the_model_still_walks(start: Start, store: Store) -> None:
    def fake(plan: PlanName, robot: Robot) -> Procedure:
        return two_sequences(plan, robot)

    orchestrator = start(fake, SETTINGS)
    calibration = calibrate(orchestrator, "paper")
    outcome = store.calibration(apply(orchestrator, calibration))
    assert (outcome.state, outcome.verdict) == ("failed", None)
    assert known(store, calibration).state == "unwritten"


def test_a_zero_is_in_the_journal_on_disk_before_its_drive_is_told(
    station: Orchestrator, store: Store, rig: Rig
) -> None:
    calibration = calibrate(station)
    seen: list[tuple[int, int | None]] = []

    def look(joint: int) -> None:
        with sqlite3.connect(store.path) as other:  # a connection of its own sees what is committed alone
            rows = other.execute("SELECT joint, taken FROM zero_writes ORDER BY id").fetchall()
        other.close()
        seen.append(rows[-1])
        assert rows[-1] == (joint, None), "told before it was written down"

    for joint in (1, 2):
        rig.script.do(f"axis {joint} preset", partial(look, joint))
    assert store.calibration(apply(station, calibration)).verdict == "pass"
    assert seen == [(1, None), (2, None)]


def test_a_check_that_is_no_number_takes_the_zeros_back(
    station: Orchestrator, store: Store, rig: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibration = calibrate(station)
    checks = iter([1.0, float("nan")])

    def verified(fit: object, fresh: Measurements, *, offset_known: bool) -> Verification:
        return Verification(np.zeros(len(fresh)), np.ones(len(fresh)), next(checks))

    monkeypatch.setattr("station.run_kinds.apply.verify", verified)
    outcome = store.calibration(apply(station, calibration))
    assert (outcome.verdict, outcome.outcome) == ("fail", "not_verified")
    assert offsets(rig) == pytest.approx(OFFSETS, abs=1e-6)
    assert known(store, calibration).state == "rolled back"
