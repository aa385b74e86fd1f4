"""Chain of turns and shifts against homogeneous matrices, derivatives against differences."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from station.errors import InputRefused
from station.serial_arm.dh import reach
from station.serial_arm.mechanism import SerialArm
from station.studies.arms.physics import (
    CRAIG_SEVEN,
    LIFTED,
    UR_LIKE,
    SimulatedArm,
    random_arm,
    random_poses,
)

ARMS = pytest.mark.parametrize("data", [UR_LIKE, CRAIG_SEVEN, LIFTED], ids=["standard", "modified", "lifted"])


def parameters_of(arm: SimulatedArm, mechanism: SerialArm) -> Any:
    """(P,) the arm's true errors in the order of the mechanism."""
    p = mechanism.start
    n = arm.robot.joints
    p[:n] = arm.errors[:, 0]
    p[n : 6 * n] = arm.errors[:, 1:].ravel()
    for joint in arm.robot.sliding:
        about, along = arm.errors[joint - 1, :2]
        p[joint - 1], p[n + 5 * (joint - 1)] = along / 1000.0, about
    p[6 * n : 6 * n + 3] = arm.tool - np.array(arm.robot.tool_mm)
    return p


@ARMS
def test_positions_are_those_of_matrices(data: dict[str, Any]) -> None:
    arm = random_arm(data, 3)
    arm.base = np.eye(4)
    theta = random_poses(arm.robot.joints, 40, 1)
    at = reach(arm.robot.links, arm.errors, arm.tool, theta)
    expected = np.array([arm.position(angles) for angles in theta])
    assert np.abs(at.end - expected).max() < 1e-9


@ARMS
@pytest.mark.parametrize("by_range", [False, True], ids=["position", "range"])
def test_every_derivative_against_differences(data: dict[str, Any], by_range: bool) -> None:
    arm = random_arm(data, 4)
    m = arm.log(random_poses(arm.robot.joints, 12, 2))
    mechanism = SerialArm(arm.robot, replace(m, tracker=None) if by_range else m)
    p = parameters_of(arm, mechanism)
    p[-3:] += 0.05  # turns of the base, or mm of the origin
    at = mechanism.observe(p, m.theta)
    for k in range(len(p)):
        step = np.zeros(len(p))
        step[k] = 1e-5
        high, low = (mechanism.observe(p + sign * step, m.theta).value for sign in (1.0, -1.0))
        assert np.abs((high - low) / 2e-5 - at.by_parameter[:, k]).max() < 2e-5 * 3000.0
    for i in range(m.joints):
        step = np.zeros(m.joints)
        step[i] = 1e-6
        high, low = (mechanism.observe(p, m.theta + sign * step).value for sign in (1.0, -1.0))
        assert np.abs((high - low) / 2e-6 - at.by_joint[:, i]).max() < 1e-3


@ARMS
def test_the_base_is_found_from_the_readings(data: dict[str, Any]) -> None:
    arm = random_arm(data, 5)
    mechanism = SerialArm(arm.robot, arm.log(random_poses(arm.robot.joints, 200, 3)))
    mechanism.check()
    off = np.linalg.norm(
        (mechanism.observe(mechanism.start, mechanism.theta).value - mechanism.measured).reshape(-1, 3),
        axis=1,
    )
    assert np.median(off) < 120.0  # the target stands 70 mm off the flange


def test_exchanged_joints_are_refused() -> None:
    arm = random_arm(UR_LIKE, 6)
    m = arm.log(random_poses(6, 200, 4))
    swapped = replace(m, theta=m.theta[:, [2, 1, 0, 3, 4, 5]])
    with pytest.raises(InputRefused, match="Angles and readings do not belong together"):
        SerialArm(arm.robot, swapped).check()
