"""The way back: from where no other run may start, slowly, past a scale that does not read."""

from __future__ import annotations

import pytest

from drivers.errors import DeviceFault
from station.five_bar import Robot
from station.motion.way_back import outside_mm
from station.service.orchestrator import Orchestrator
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import Start
from tests.station.fakes import FakeAxis, Rig

LIMIT_S = 20.0
OUTSIDE_DEG = [(-50.0, 230.0), (40.0, 140.0), (-45.0, 140.0), (60.0, 240.0), (30.0, 200.0)]


def put(rig: Rig, theta_deg: tuple[float, float]) -> None:
    rig.axes[0].theta_deg, rig.axes[1].theta_deg = theta_deg


def stands_deg(rig: Rig) -> tuple[float, float]:
    return rig.axes[0].theta_deg, rig.axes[1].theta_deg


def retracted(orchestrator: Orchestrator, store: Store) -> tuple[str, str | None, str, str]:
    run = orchestrator.retract("ada").id
    assert orchestrator.wait(run, LIMIT_S).ended
    ended = store.calibration(run)
    assert (ended.kind, ended.plan, ended.operator) == ("retract", "retract", "ada")
    return ended.state, ended.verdict, ended.outcome or "", ended.reason or ""


@pytest.mark.parametrize("theta_deg", OUTSIDE_DEG)
def test_the_arm_comes_back_and_the_next_run_succeeds(
    start: Start, store: Store, rig: Rig, theta_deg: tuple[float, float]
) -> None:
    put(rig, theta_deg)
    speeds: list[float] = []
    for axis in rig.axes:
        spy(axis, speeds)
    orchestrator = start()
    state, verdict, outcome, reason = retracted(orchestrator, store)
    assert (state, verdict, outcome) == ("succeeded", None, "good"), reason
    assert "The arm is back in its workspace" in reason
    assert outside_mm(Robot.default(), stands_deg(rig)) <= -4.9
    assert speeds and max(speeds) <= 5.0
    speeds.clear()
    run = orchestrator.submit(asked("R1", "paper")).id
    assert orchestrator.wait(run, LIMIT_S) == "succeeded"


def spy(axis: FakeAxis, speeds: list[float]) -> None:
    """Note the speeds that an axis is told from now on."""
    move_to = axis.move_to

    def move(theta_deg: float, speed_deg_s: float) -> None:
        speeds.append(speed_deg_s)
        move_to(theta_deg, speed_deg_s)

    axis.move_to = move  # type: ignore[method-assign]


def test_the_station_says_that_the_arm_stands_outside(start: Start, store: Store, rig: Rig) -> None:
    put(rig, (-45.0, 140.0))
    orchestrator = start()
    retracted(orchestrator, store)
    inside = orchestrator.snapshot().retract
    assert (inside.needed, inside.excess_mm) == (False, 0.0)
    put(rig, (-45.0, 140.0))
    orchestrator._machine.watch()
    outside = orchestrator.snapshot().retract
    assert outside.needed
    assert outside.excess_mm == pytest.approx(outside_mm(Robot.default(), (-45.0, 140.0)), abs=0.001)
    assert f"{outside.excess_mm:.1f} mm outside" in outside.text


def test_it_works_without_a_scale(start: Start, store: Store, rig: Rig) -> None:
    """Out there the head may be off its scale."""
    put(rig, (-45.0, 140.0))
    rig.script.fail("scale read", DeviceFault("no signal"))
    orchestrator = start()
    orchestrator._machine.watch()
    assert orchestrator.snapshot().retract.needed
    assert retracted(orchestrator, store)[0] == "succeeded"


def test_an_arm_that_stands_inside_is_not_moved(start: Start, store: Store, rig: Rig) -> None:
    state, _, _, reason = retracted(start(), store)
    assert (state, "nothing was moved" in reason) == ("succeeded", True)
    assert "axis 1 move_to" not in rig.script.calls


def test_a_step_that_leads_away_ends_it(start: Start, store: Store, rig: Rig) -> None:
    """A drive that goes elsewhere than it was told."""
    put(rig, (-45.0, 140.0))
    rig.axes[1].stands_off_deg = -3.0
    state, _, _, reason = retracted(start(), store)
    assert state == "failed"
    assert "joint 2 stands at" in reason or "led away" in reason


def test_it_can_be_stopped(start: Start, store: Store, rig: Rig) -> None:
    put(rig, (-45.0, 140.0))
    orchestrator = start()

    def stop() -> None:
        assert orchestrator._run is not None
        orchestrator._run.cancel.set()

    rig.script.do("axis 2 move_to", stop, at=2)
    assert retracted(orchestrator, store)[0] == "aborted"
