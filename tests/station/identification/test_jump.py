"""A jump of the readout or of a joint is named at its reading, or fails the verdict, in every plan.

Null hypothesis: the readings are those of a machine within the tolerances, with the specified noise.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from station.five_bar import FiveBar, Robot
from station.identification import identification_document, identify
from station.identification.jump import READOUT, find_jump
from station.plans import make_plan
from station.records import CalibrationResult, PlanName, Reading, Step, from_readings
from station.studies.simulation import SimulatedMachine
from tests.station.asking import start_procedure
from tests.station.simulated import calibrated, carried_out, group

ROBOT = Robot.default()
JUMP_MM = 0.1


class Jumping:
    """A procedure whose readings are `JUMP_MM` longer from the reading `at` on; keeps them all."""

    def __init__(self, procedure: Generator[Step, Any, CalibrationResult], at: int) -> None:
        self.readings: list[Reading] = []
        self._procedure = procedure
        self._at = at

    def __next__(self) -> Step:
        return next(self._procedure)

    def send(self, readings: list[Reading]) -> Step:
        first = len(self.readings) + 1
        jumped = [
            replace(r, scale_mm=r.scale_mm + JUMP_MM) if number >= self._at else r
            for number, r in enumerate(readings, start=first)
        ]
        self.readings += jumped
        return self._procedure.send(jumped)


def run(plan: str, at: int, seed: int) -> tuple[CalibrationResult, list[Reading]]:
    procedure = Jumping(start_procedure(plan, ROBOT), at)
    result = calibrated(procedure, ROBOT, group(1 + seed % 6), seed=seed)  # type: ignore[arg-type]
    return result, procedure.readings


@pytest.mark.parametrize("at", range(2, 25))
def test_a_jump_in_plan_paper(at: int) -> None:
    result, readings = run("paper", at, seed=at)
    if at > len(readings):
        pytest.skip("the run needed fewer readings")
    assert result.verdict == "fail", f"{at} of {len(readings)}"
    if "reading" in result.reason.params:
        assert abs(int(str(result.reason.params["reading"])) - at) <= 1


@pytest.mark.parametrize(("plan", "at"), [*(("rapid", at) for at in range(2, 15)), ("full", 2), ("full", 75)])
def test_a_jump_in_another_plan(plan: str, at: int) -> None:
    result, readings = run(plan, at, seed=at)
    assert at <= len(readings)
    assert result.verdict == "fail"


def test_a_sound_run_has_none() -> None:
    for seed in range(6):
        result, readings = run("paper", 10_000, seed)
        assert result.verdict == "pass", result.reason
        assert find_jump(FiveBar(ROBOT, from_readings(readings))) is None


def test_it_is_named_with_its_size() -> None:
    _, readings = run("rapid", 10_000, 1)
    jumped = [replace(r, scale_mm=r.scale_mm + JUMP_MM) if r.reading >= 9 else r for r in readings]
    jump = find_jump(FiveBar(ROBOT, from_readings(jumped)))
    assert jump is not None
    assert (jump.index, jump.thing) == (8, READOUT)
    assert jump.size == pytest.approx(JUMP_MM, abs=0.02)


def slipping(joint: int, size_deg: float, visit: int, seed: int = 3) -> SimulatedMachine:
    """A machine whose joint loses counts before a visit."""
    slip = {"kind": "count_slip", "joint": joint, "step_deg": size_deg, "from_stop": visit}
    return SimulatedMachine(ROBOT, group(1 + seed % 6), "whole pulses", seed, [slip])


@pytest.mark.parametrize(
    ("plan", "joint", "size_deg", "visit"),
    [
        ("rapid", 1, 0.02, 8),
        ("rapid", 2, -0.5, 14),
        ("full", 1, 0.5, 67),
        ("full", 2, -0.1, 119),
        ("full", 2, 0.02, 205),
        ("paper", 1, 0.1, 4),
        ("paper", 2, -0.1, 18),
        ("adaptive", 1, 0.1, 5),
    ],
)
def test_a_joint_that_slips_during_a_run(plan: PlanName, joint: int, size_deg: float, visit: int) -> None:
    _, result = carried_out(slipping(joint, size_deg, visit), start_procedure(plan, ROBOT), samples=5)
    assert (result.verdict, result.outcome) == ("fail", "unexplained")
    assert result.reason.code in ("joint_slipped", "something_jumped")
    if result.reason.code == "joint_slipped":
        assert result.reason.params["joint"] == joint
        assert abs(float(str(result.reason.params["slip_deg"]))) == pytest.approx(abs(size_deg), rel=0.2)


@pytest.mark.parametrize(
    "slips", [((1, 0.1, 57), (2, -0.02, 57)), ((1, -0.1, 127), (1, -0.5, 65)), ((2, 0.02, 153), (1, 0.1, 59))]
)
def test_a_collision_that_moves_both_joints_or_one_twice(slips: tuple[tuple[int, float, int], ...]) -> None:
    effects = [
        {"kind": "count_slip", "joint": joint, "step_deg": size, "from_stop": at} for joint, size, at in slips
    ]
    machine = SimulatedMachine(ROBOT, group(2), "whole pulses", 4, effects)
    _, result = carried_out(machine, start_procedure("full", ROBOT), samples=5)
    assert (result.verdict, result.reason.code) == ("fail", "something_jumped")


@pytest.mark.parametrize("from_the_end", [2, 6, 40])
def test_a_slip_near_the_end_of_a_file_is_no_row_of_outliers(from_the_end: int) -> None:
    stops = make_plan("full", ROBOT).stops
    before = SimulatedMachine(ROBOT, group(2), "whole pulses", 5).run(stops, 5)
    after = slipping(1, 0.2, 1, seed=1).run(stops, 5)
    later = np.arange(len(stops)) >= len(stops) - from_the_end
    slipped = replace(
        before,
        theta=np.where(later[:, None], after.theta, before.theta),
        distance=np.where(later, after.distance, before.distance),
    )
    found = identify(ROBOT, slipped)
    document = identification_document(found)
    assert not found.outliers
    assert document.jump is not None
    assert document.jump.reading == len(stops) - from_the_end + 1
    assert document.jump.thing in ("joint 1", None)
    assert not document.residual.adequate
