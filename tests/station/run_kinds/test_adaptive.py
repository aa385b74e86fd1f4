"""Plan `adaptive`: few readings after a collision, promises kept, wrong memories refused, wishes met."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np
import pytest

from station.five_bar import Robot
from station.identification import bounds_mm, identify
from station.plans import USUAL, make_plan
from station.records import JointAngle, Real, Remembered
from station.run_kinds.adaptive import adaptive_run, fit_in_sequence
from station.studies.drawn import Drawn, drawn, robot_of
from station.studies.walked import Walked, walk

ROBOT = robot_of(0.03)
WISH = 1.02
"""Of what the full run reached."""


@dataclass(frozen=True)
class Struck:
    """A machine that ran into something after a full run."""

    machine: Drawn
    memory: Remembered
    full_mm: float

    def run(self, wanted_mm: float | None, *, memory: bool = True, truth: Real | None = None) -> Walked:
        machine = self.machine if truth is None else Drawn(ROBOT, truth, self.machine.seed)
        remembered = self.memory if memory else None
        return walk(adaptive_run(ROBOT, remembered, wanted_mm, USUAL), machine.machine(1))


@pytest.fixture(scope="module", params=[2])
def struck(request: pytest.FixtureRequest) -> Struck:
    before, rng = drawn(ROBOT, request.param)
    found = identify(ROBOT, before.machine().run(make_plan("full", ROBOT).stops, 5))
    memory = Remembered(1, datetime.now(UTC), found.lasting.record())
    return Struck(before.struck(rng), memory, bounds_mm(found)[0])


def test_a_few_seconds_after_a_collision(struck: Struck) -> None:
    walked = struck.run(struck.full_mm * WISH)
    result = walked.result
    assert (result.verdict, result.outcome) == ("pass", "good")
    assert len(walked.readings) <= 6
    assert walked.machine_s <= 6.0
    assert result.accuracy is not None
    assert (result.accuracy.reached, result.accuracy.stopped_because) == (
        True,
        "the wanted accuracy is reached",
    )
    assert result.memory is not None
    assert result.memory.used
    assert "predicted before it was used" in result.reason.text
    fit = fit_in_sequence(ROBOT, list(walked.readings), struck.memory, 0.0)
    assert struck.machine.largest_errors_mm(fit)[0] <= (result.accuracy.bound_95_mm or 0.0)
    assert np.degrees(fit.dtheta) == pytest.approx([q.value for q in result.zero_offsets], abs=1e-6)


@pytest.mark.parametrize("turn_deg", [30.0, 200.0])
def test_a_mechanism_mounted_anew_is_noticed(struck: Struck, turn_deg: float) -> None:
    truth = struck.machine.truth.copy()
    truth[10:] += np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    result = struck.run(struck.full_mm * WISH, truth=truth).result
    assert result.memory is not None
    assert not result.memory.used


def test_a_wish_that_cannot_be_met_is_answered_early(struck: Struck) -> None:
    walked = struck.run(0.02)
    result = walked.result
    assert (result.verdict, result.outcome) == ("fail", "not_accurate_enough")
    assert len(walked.readings) <= 6
    assert result.accuracy is not None
    assert result.accuracy.stopped_because == "readings cannot reach the wanted accuracy"
    assert result.reason.code == "accuracy_out_of_reach"
    assert "0.02 mm are wanted" in result.reason.text
    assert result.reason.params["possible_mm"] < (result.accuracy.bound_95_mm or 0.0)  # type: ignore[operator]


def test_a_wish_that_anything_meets_ends_after_the_fewest_readings(struck: Struck) -> None:
    walked = struck.run(1e308)
    assert walked.result.verdict == "pass"
    assert len(walked.readings) <= 5


def test_without_a_wish_it_ends_where_more_would_not_help(struck: Struck) -> None:
    walked = struck.run(None)
    assert walked.result.verdict == "pass"
    assert walked.result.accuracy is not None
    assert walked.result.accuracy.reached is None
    assert walked.result.accuracy.stopped_because == "further readings would not help"
    assert (walked.result.accuracy.bound_95_mm or 9.9) < 1.15 * struck.full_mm


def test_nothing_is_remembered_of_a_new_robot(struck: Struck) -> None:
    walked = struck.run(None, memory=False)
    assert walked.result.verdict == "pass"
    assert walked.result.memory is None
    assert len(walked.readings) >= 6
    assert walked.result.lasting is not None


def test_a_reference_is_worth_many_readings() -> None:
    machine, rng = drawn(ROBOT, 4)
    seen_deg = float(np.degrees(machine.truth[0]) + rng.normal(0.0, 0.005))
    robot: Robot = ROBOT.informed([JointAngle(joint=1, at_deg=0.0, reads_deg=seen_deg, sd_deg=0.005)])
    walked = walk(adaptive_run(robot, None, 0.35, USUAL), machine.machine())
    assert walked.result.verdict == "pass"
    assert len(walked.readings) <= 8


def test_readings_that_no_machine_gives_are_no_pass(struck: Struck) -> None:
    machine = struck.machine.machine(1)
    effects = [{"kind": "gear_cyclic", "joint": 1, "amplitude_deg": 0.2, "per_rev": 20.0}]
    spoiled = type(machine)(ROBOT, struck.machine.truth, "whole pulses", 7, effects)
    result = walk(adaptive_run(ROBOT, struck.memory, None, USUAL), spoiled).result
    assert result.verdict == "fail"
    assert result.outcome in ("unexplained", "failed")
