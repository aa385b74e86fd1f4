"""Experiments carried out on emulated machines: what they read is physics, and what is counted."""

from __future__ import annotations

import numpy as np
import pytest

from station.diagnosis import Trial
from station.five_bar import Robot, inverse
from station.studies.experiments import figures
from station.studies.experiments.one import tried
from station.studies.simulation import SimulatedMachine
from tests.station.simulated import group

ROBOT = Robot.default()
WORN_SECTOR = 50001
CLEAN = 63 * 800


def test_a_level_sees_the_zero_offset_and_what_the_joint_does_beside_it() -> None:
    theta = inverse(ROBOT.geometry, ROBOT.workspace_grid(3, 2))
    plain = SimulatedMachine(ROBOT, group(1), "exact", 0)
    np.testing.assert_allclose(plain.arms(theta, theta - 0.02), np.tile(group(1)[:2], (6, 1)), atol=1e-9)
    worn = SimulatedMachine(
        ROBOT, group(1), "exact", 0, [{"kind": "backlash", "joint": 1, "width_deg": 0.05}]
    )
    play = worn.arms(theta, theta - 0.02) - worn.arms(theta, theta + 0.02)
    np.testing.assert_allclose(np.abs(play), np.tile([np.radians(0.05), 0.0], (6, 1)), atol=1e-6)


def test_a_place_is_reached_from_the_side_that_was_asked_for() -> None:
    machine = SimulatedMachine(ROBOT, group(1), "exact", 0)
    theta = inverse(ROBOT.geometry, ROBOT.workspace_grid(2, 2))
    sides = np.array([[1, -1], [-1, -1], [-1, 1], [1, 1]])
    taken = machine.arrive(theta, theta - 0.02 * sides)
    np.testing.assert_array_equal(taken.approach, sides)
    np.testing.assert_allclose(taken.theta, theta, atol=np.radians(0.002))


def test_every_experiment_of_an_open_question_is_carried_out() -> None:
    found = tried(WORN_SECTOR)
    kinds = ["motion", "reference of joint 1", "reference of joint 2", "second mount"]
    assert [one.kind for one in found] == kinds
    assert all(0.0 <= one.predicted <= 1.0 for one in found)
    assert found == tried(WORN_SECTOR)


def test_a_clean_machine_has_no_question() -> None:
    assert tried(CLEAN) == ()


def test_shares_are_counted_by_kind_and_by_prediction() -> None:
    machines = [
        (Trial("motion", 0.05, False), Trial("gauge", 1.0, True)),
        (),
        (Trial("motion", 0.95, True), Trial("gauge", 0.9, False)),
    ]
    found = figures(machines)
    assert (found["machines"], found["questions"]) == (3, 2)
    assert found["experiments"] == {
        "gauge": {
            "machines": 2, "predicted": 0.95, "observed": 0.5,
            "by_prediction": [{"machines": 2, "predicted": 0.95, "observed": 0.5}],
        },
        "motion": {
            "machines": 2, "predicted": 0.5, "observed": 0.5,
            "by_prediction": [
                {"machines": 1, "predicted": 0.05, "observed": 0.0},
                {"machines": 1, "predicted": 0.95, "observed": 1.0},
            ],
        },
    }  # fmt: skip


@pytest.mark.parametrize("machines", [[], [()]])
def test_nothing_to_decide_is_no_error(machines: list[tuple[Trial, ...]]) -> None:
    assert figures(machines)["experiments"] == {}
