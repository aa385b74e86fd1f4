"""What a run of any plan leaves can be applied, and the next run of any plan can build upon it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from drivers.emulated.spec import MachineSpec
from station.five_bar import Robot
from station.records import CalibrationRequest, PlanName, State
from station.simulation.plant import Plant

pytestmark = pytest.mark.long

ROBOT = Robot.default()
SPEC = MachineSpec(seed=3, zero_offsets_deg=(0.7, -0.4), drm_mm=(1.1, 0.4))


@pytest.fixture
def plant(tmp_path: Path) -> Iterator[Plant]:
    plant = Plant(tmp_path / "home", [SPEC], Random(1))
    with plant.entered():
        assert plant.start(), plant.refusal
        yield plant
        plant.scheduler.end()


def carried_out(plant: Plant, run: int) -> State:
    """Until the run is over; an operator does what it asks."""
    assert plant.runtime is not None
    station = plant.runtime.orchestrator
    while station.running == run:
        plant.scheduler.wait(seconds=0.5)
        if (prompt := plant.ask(lambda station: station.prompt(run))) is None:
            continue
        value = plant.machine.axes[0].arm_deg(plant.scheduler.now_s) if prompt.kind == "number" else None
        if prompt.kind == "confirm":
            plant.machine.remount(ROBOT.second_mount[1])
        plant.ask(lambda station: station.answer(run, prompt.id, value, "ada"))  # noqa: B023
    plant.machine.remount(ROBOT.c)
    return plant.runtime.store.summary(run).state


@pytest.mark.parametrize("plan", ["adaptive", "reference", "two_mounts"])
def test_what_a_plan_leaves_is_applied_and_built_upon(plant: Plant, plan: PlanName) -> None:
    assert plant.runtime is not None
    store = plant.runtime.store
    first = plant.ask(lambda station: station.submit(CalibrationRequest("S", "calibrate", "ada", plan)).id)
    assert carried_out(plant, first) is State.SUCCEEDED
    assert store.summary(first).verdict == "pass"
    applied = plant.ask(lambda station: station.follow("apply", first, "ada").id)
    assert carried_out(plant, applied) is State.SUCCEEDED, store.summary(applied).reason
    following: tuple[PlanName, ...] = ("adaptive", "check")
    for plan in following:
        kind = "check" if plan == "check" else "calibrate"
        asked = CalibrationRequest("S", kind, "ada", plan)
        run = plant.ask(lambda station: station.submit(asked).id)  # noqa: B023
        assert carried_out(plant, run) is State.SUCCEEDED, (plan, store.summary(run).reason)
