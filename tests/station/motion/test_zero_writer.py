"""Zeros for the drives: what is written down, when, and what a write that was cut off is taken for."""

from __future__ import annotations

from threading import Event

import pytest

from drivers.errors import DeviceFault
from station.errors import StepFailed
from station.five_bar.robot_file import Robot
from station.motion import Cancelled, Listeners, Machine, Positioner
from station.motion.zero_writer import Zeroing, shift_of
from station.records import SetZeros, ZeroWrite
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import SETTINGS
from tests.station.fakes import HOME_DEG, Rig

ROBOT = Robot.default("R1")
PULSE = ROBOT.pulse_deg
OFFSETS = (0.8, -0.6)


class Bench:
    """A run of kind apply about run 1, ready to write."""

    def __init__(self, store: Store, rig: Rig) -> None:
        self.store, self.rig, self.cancel = store, rig, Event()
        self.of = store.create(asked("R1", "rapid"), ROBOT)
        self.run = store.create(asked("R1", "apply", of=self.of), ROBOT)
        machine = Machine(rig.devices, SETTINGS.limits, Listeners(), SETTINGS.interlocks)
        self.positioner = Positioner(machine, ROBOT, SETTINGS.joints, self.cancel)
        machine.connect_missing()
        machine.ready_axes()  # as a run does before its first step
        self.zeroing = Zeroing(self.run, machine, self.positioner, store)
        for axis, offset in zip(rig.axes, OFFSETS, strict=True):
            axis.offset_deg = offset

    def set(self, offsets: tuple[float, float]) -> tuple[float, float]:
        return self.zeroing.carry_out(SetZeros("Writing", 2, self.of, offsets))

    def journal(self) -> list[tuple[int, float, float, float | None, bool | None]]:
        return [(w.joint, w.offset_deg, w.from_deg, w.to_deg, w.taken) for w in self.store.zero_writes("R1")]


@pytest.fixture
def bench(store: Store, rig: Rig) -> Bench:
    return Bench(store, rig)


def test_both_zeros_are_declared_where_they_shall_be(bench: Bench) -> None:
    shift = bench.set(OFFSETS)
    assert shift == pytest.approx((-0.8, 0.6))
    assert [axis.offset_deg for axis in bench.rig.axes] == pytest.approx([0.0, 0.0])
    assert [entry[:2] for entry in bench.journal()] == [(1, 0.8), (2, -0.6)]
    assert [entry[2] for entry in bench.journal()] == pytest.approx([-0.8, 180.6])
    assert [entry[3:] for entry in bench.journal()] == [(0.0, True), (180.0, True)]
    calls = [call for call in bench.rig.script.calls if call.endswith(("preset", "move_to"))]
    assert calls.index("axis 1 preset") > calls.index("axis 2 move_to"), "both stand before one is told"
    # back to the old zeros: only what was moved is moved back
    assert bench.set((0.0, 0.0)) == pytest.approx((0.0, 0.0))
    assert [axis.offset_deg for axis in bench.rig.axes] == pytest.approx(OFFSETS)
    count = len(bench.journal())
    assert bench.set((0.0, 0.0)) == pytest.approx((0.0, 0.0))
    assert len(bench.journal()) == count, "a joint that has its old zero is left alone"


def test_one_joint_alone_moves_no_zero_of_the_other(bench: Bench) -> None:
    assert bench.set((0.8, 0.0)) == pytest.approx((-0.8, 0.0))
    assert [entry[0] for entry in bench.journal()] == [1]
    assert "axis 2 preset" not in bench.rig.script.calls


def test_a_machine_that_cannot_be_made_safe_gets_no_zero(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("station.motion.machine.STANDSTILL_LIMIT_S", 0.0)
    bench.rig.script.fail("axis 1 quick_stop", DeviceFault("it does not stop"))
    bench.rig.axes[0].moving = True
    with pytest.raises(StepFailed, match=r"^Standstill could not be confirmed, look at the arm"):
        bench.set(OFFSETS)
    assert bench.journal() == []
    assert "axis 1 preset" not in bench.rig.script.calls


def test_a_stop_between_the_two_leaves_the_first(bench: Bench) -> None:
    bench.rig.script.do("axis 1 preset", bench.cancel.set)
    with pytest.raises(Cancelled):
        bench.set(OFFSETS)
    assert [(entry[0], entry[4]) for entry in bench.journal()] == [(1, True)]


@pytest.mark.parametrize("joint", [1, 2])
@pytest.mark.parametrize(
    ("pulses", "accepted"), [(0.5, True), (1.0, True), (-1.0, True), (4.0, True), (5.0, False), (-5.0, False)]
)
def test_a_zero_must_read_back_but_for_the_noise_of_the_feedback(
    bench: Bench, joint: int, pulses: float, accepted: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    axis = bench.rig.axes[joint - 1]
    declare = axis.preset
    monkeypatch.setattr(axis, "preset", lambda theta_deg: declare(theta_deg + pulses * PULSE))
    offsets = (0.8, 0.0) if joint == 1 else (0.0, 0.8)
    if accepted:
        shift = bench.set(offsets)
        assert shift[joint - 1] == pytest.approx(-0.8 - pulses * PULSE)
        return
    with pytest.raises(StepFailed, match=rf"^The zero of joint {joint} reads back "):
        bench.set(offsets)
    # it stands near its new zero all the same, so the drive took one
    assert [(entry[0], entry[4]) for entry in bench.journal()] == [(joint, True)]


@pytest.mark.parametrize(
    ("stands", "taken"),
    [
        (0.0, True),
        (19 * PULSE, True),
        (-0.8, False),
        (-0.8 - 19 * PULSE, False),
        (5.0, None),
        (21 * PULSE, None),
    ],
)
def test_a_write_that_was_cut_off_is_taken_for_what_the_joint_shows(
    bench: Bench, stands: float, taken: bool | None
) -> None:
    bench.store.begin_zero_write(bench.run, 1, 0.8, -0.8)
    bench.rig.axes[0].theta_deg = stands
    bench.zeroing.settle()
    to_deg = stands if taken else None
    assert bench.journal() == [(1, 0.8, -0.8, to_deg, taken)]
    bench.zeroing.settle()
    assert bench.journal() == [(1, 0.8, -0.8, to_deg, taken)]


def test_what_is_settled_does_not_hide_what_is_open(bench: Bench) -> None:
    bench.store.end_zero_write(bench.store.begin_zero_write(bench.run, 1, 0.8, -0.8), 0.0)
    bench.store.begin_zero_write(bench.run, 2, -0.6, 180.6)
    bench.zeroing.settle()
    assert [(entry[0], entry[4]) for entry in bench.journal()] == [(1, True), (2, True)]


def test_zeros_of_another_robot_are_not_settled(bench: Bench) -> None:
    other = bench.store.create(asked("R2", "apply", of=bench.of), Robot.default("R2"))
    bench.store.begin_zero_write(other, 1, 0.8, HOME_DEG[0])
    bench.zeroing.settle()
    assert bench.store.zero_writes("R2")[0].taken is None


def write(joint: int, shift: float | None, taken: bool | None = True) -> ZeroWrite:
    home = HOME_DEG[joint - 1]
    to = None if shift is None else home
    return ZeroWrite(1, 7, 1, joint, 0.0, home + (shift or 0.0), to, taken)


def test_shifts_add_up_joint_by_joint() -> None:
    assert shift_of([]) == (0.0, 0.0)
    writes = [write(1, -0.5), write(2, 0.25), write(1, 0.125), write(2, 9.0, taken=False)]
    assert shift_of(writes) == (-0.375, 0.25)
    with pytest.raises(StepFailed) as failed:
        shift_of([*writes, write(2, None, taken=None)])
    assert str(failed.value) == (
        "Whether joint 2 took the zero of run 7 cannot be told any more; calibrate again."
    )


def test_a_drive_that_lost_its_power_gets_no_zero(bench: Bench) -> None:
    bench.set(OFFSETS)
    count = len(bench.journal())
    bench.rig.axes[0].enabled = False
    with pytest.raises(StepFailed, match="Axis 1 has lost its power"):
        bench.set((0.0, 0.0))
    assert len(bench.journal()) == count, "nothing was begun"
    assert bench.rig.script.calls.count("axis 1 preset") == 1


def test_an_alarm_takes_no_position_away(bench: Bench) -> None:
    bench.set(OFFSETS)
    bench.rig.axes[0].enabled, bench.rig.axes[0].alarm = False, 0x180
    assert bench.set((0.0, 0.0)) == pytest.approx((0.0, 0.0))
