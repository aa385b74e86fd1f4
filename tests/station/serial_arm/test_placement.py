"""Several points on the tool, several set-ups in one log, a lifting column under the arm."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from station.diagnosis.tests_of_fit.cross_validation import folds
from station.errors import InputRefused
from station.identification import identify
from station.records import ColumnMap, Measurements, Real, parse_measurements, translated
from station.serial_arm.mechanism import SerialArm
from station.serial_arm.placement import FEWEST
from station.studies.arms.physics import LIFTED, UR_LIKE, random_arm, random_poses, shift, turn

POINTS = np.array([[20.0, -35.0, 60.0], [-50.0, 10.0, 80.0]])


def two_points_in_two_setups(by_range: bool = False) -> tuple[Any, Measurements]:
    """Every other reading of the other point; the tracker is moved after 60 of 150."""
    arm = random_arm(UR_LIKE, 21)
    theta = random_poses(6, 150, 21)
    mount = np.arange(150) % 2
    setup = np.repeat([0, 1], [60, 90])
    bases = (arm.base, shift("x", -1800.0) @ turn("z", 2.1) @ turn("y", 0.2))
    seen: list[Real] = []
    for pose, m, s in zip(theta, mount, setup, strict=True):
        arm.tool, arm.base = POINTS[m], bases[s]
        seen.append(arm.position(pose))
    tracker = np.array(seen) + np.random.default_rng(1).normal(0.0, 0.02, (150, 3))
    return arm.robot, replace(
        arm.log(theta),
        tracker=None if by_range else tracker,
        distance=np.linalg.norm(tracker, axis=1),
        mount=mount,
        mounts=("A", "B"),
        setup=setup,
        setups=("morning", "evening"),
    )


@pytest.mark.parametrize("by_range", [False, True], ids=["position", "range"])
def test_each_point_and_each_setup_is_placed(by_range: bool) -> None:
    robot, m = two_points_in_two_setups(by_range)
    mechanism = SerialArm(robot, m)
    mechanism.check()
    found = identify(robot, m)
    assert float(np.sqrt(np.mean(found.solution.residual**2))) < 1.1
    x = dict(zip([p.name for p in mechanism.parameters], found.solution.x, strict=True))
    apart = [x[f"tool_{a}@B"] - x[f"tool_{a}"] for a in "xyz"]
    # what the two points have in common could be the last link as well
    assert np.linalg.norm(apart) == pytest.approx(np.linalg.norm(POINTS[1] - POINTS[0]), abs=0.1)
    assert ("origin_x@evening" if by_range else "base_rz@evening") in x


@pytest.mark.parametrize("by_range", [False, True], ids=["position", "range"])
def test_derivatives_of_points_and_setups_against_differences(by_range: bool) -> None:
    robot, m = two_points_in_two_setups(by_range)
    mechanism = SerialArm(robot, m)
    p = mechanism.start + 0.01
    at = mechanism.observe(p, m.theta)
    for k in range(36, len(p)):
        step = np.zeros(len(p))
        step[k] = 1e-5
        high, low = (mechanism.observe(p + sign * step, m.theta).value for sign in (1.0, -1.0))
        assert np.abs((high - low) / 2e-5 - at.by_parameter[:, k]).max() < 0.06


def test_every_setup_is_in_every_fold() -> None:
    _, m = two_points_in_two_setups()
    assert [len(np.unique(folds(m)[m.setup_index == s])) for s in (0, 1)] == [4, 4]


def test_a_setup_of_few_readings_is_refused() -> None:
    robot, m = two_points_in_two_setups()
    few = m.take(np.flatnonzero((m.setup_index == 1) | (np.arange(150) < FEWEST - 1)))
    with pytest.raises(InputRefused, match="Set-up 'morning' has 5 readings; at least 6"):
        SerialArm(robot, few).check()


def test_the_travel_of_a_column_is_a_joint_with_a_zero_offset_in_millimetres() -> None:
    arm = random_arm(LIFTED, 22)
    theta = random_poses(7, 200, 22)
    theta[:, 0] = np.random.default_rng(3).uniform(0.0, 0.6, 200)
    m = arm.log(theta)
    mechanism = SerialArm(arm.robot, m)
    mechanism.check()
    assert [(p.name, p.unit) for p in mechanism.parameters[:2]] == [("dtheta1", "mm"), ("dtheta2", "deg")]
    found = identify(arm.robot, m)
    assert float(np.sqrt(np.mean(found.solution.residual**2))) < 1.1


def test_a_log_with_a_travel_is_read_in_any_unit() -> None:
    columns = random_arm(LIFTED, 22).robot.columns
    rows = [",".join(map(str, [0.1 * k, *[10.0 * k + j for j in range(6)], 500, k, 2])) for k in range(1, 7)]
    content = "\n".join(["lift,q1,q2,q3,q4,q5,q6,x,y,z", *rows]).encode()
    given = ColumnMap.parse(
        b'[columns]\ntheta_deg = {columns = ["lift", "q1", "q2", "q3", "q4", "q5", "q6"], '
        b'unit = ["m", "deg", "deg", "deg", "deg", "deg", "deg"]}\ntracker_mm = ["x", "y", "z"]\n'
    )
    m = parse_measurements(translated(content, given, columns, "log").content, columns)
    assert (m.sliding, m.theta[2, 0], m.theta[2, 1]) == (
        (1,),
        pytest.approx(0.3),
        pytest.approx(np.radians(30.0)),
    )
