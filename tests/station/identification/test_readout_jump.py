"""A jump of the readout is named at its reading, or fails the verdict, in every plan.

Null hypothesis: the readings are those of a machine within the tolerances, with the specified noise.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any

import pytest

from station.five_bar import Robot
from station.identification.readout_jump import find_jump
from station.records import CalibrationResult, Reading, Step
from tests.station.asking import start_procedure
from tests.station.simulated import calibrated, group

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
    if result.reason.code == "readout_jumped":
        assert abs(int(result.reason.params["reading"]) - at) <= 1


@pytest.mark.parametrize(("plan", "at"), [*(("rapid", at) for at in range(2, 15)), ("full", 2), ("full", 75)])
def test_a_jump_in_another_plan(plan: str, at: int) -> None:
    result, readings = run(plan, at, seed=at)
    assert at <= len(readings)
    assert result.verdict == "fail"


def test_a_sound_run_has_none() -> None:
    for seed in range(6):
        result, readings = run("paper", 10_000, seed)
        assert result.verdict == "pass", result.reason
        assert find_jump(ROBOT, readings) is None


def test_it_is_named_with_its_size() -> None:
    _, readings = run("rapid", 10_000, 1)
    jumped = [replace(r, scale_mm=r.scale_mm + JUMP_MM) if r.reading >= 9 else r for r in readings]
    jump = find_jump(ROBOT, jumped)
    assert jump is not None
    assert (jump.reading, jump.position) == (9, readings[8].position)
    assert jump.size_mm == pytest.approx(JUMP_MM, abs=0.02)
