"""Angles and readings that are not of the same moment are named as that, not as play of the joints."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis import TracedFindings, traced, without_a_quarter
from station.records import Measurements, Real, with_guesses
from station.serial_arm import Arm
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses

SHARE = 0.001
"""Of the last motion, that is missing."""


def missing(theta: Real) -> Real:
    return -SHARE * np.diff(theta, prepend=theta[0])


def play(theta: Real) -> Real:
    return np.asarray(np.radians(-0.01) * np.sign(np.diff(theta, prepend=theta[0] - 1.0)))


def judged(arm: Arm, m: Measurements) -> TracedFindings:
    return TracedFindings(traced(arm, *without_a_quarter(m)))


def test_a_lag_of_all_joints_is_one_effect() -> None:
    arm = random_arm(UR_LIKE, 1, **{f"j{i}": missing for i in range(1, 7)})
    found = judged(arm.robot, arm.log(random_poses(6, 160, 1), 1))
    (lag,) = found.effects
    assert (lag.label, found.decision.verdict, found.decision.confirmed) == ("lag", "explained", True)
    assert lag.parameters[0].value == pytest.approx(100.0 * SHARE, abs=3.0 * lag.parameters[0].sd)
    assert lag.parameters[0].sd < 10.0 * SHARE


def test_a_lag_of_one_joint_is_named_by_joint() -> None:
    arm = random_arm(UR_LIKE, 2, j2=missing)
    found = judged(arm.robot, arm.log(random_poses(6, 160, 2), 2))
    assert [effect.label for effect in found.effects] == ["lag of joint 2"]
    assert found.decision.confirmed


def test_play_is_not_taken_for_a_lag() -> None:
    arm = random_arm(UR_LIKE, 3, j2=play)
    found = judged(arm.robot, arm.log(random_poses(6, 160, 3), 3))
    assert [effect.label for effect in found.effects] == ["backlash of joint 2"]
    assert found.effects[0].aliases == ()


def test_steps_of_one_size_leave_lag_and_play_undecided() -> None:
    """Back and forth by the same angle: half the play and a share of the motion are one number."""
    poses = random_poses(6, 160, 4)
    poses[:, 1] = np.where(np.arange(160) % 2, 0.4, -0.4)
    arm = random_arm(UR_LIKE, 4, j2=play)
    (effect,) = judged(arm.robot, arm.log(poses, 4)).effects
    assert effect.label == "backlash of joint 2"  # the more common one
    assert "lag of joint 2" in effect.alias_labels


@pytest.mark.parametrize("late_ms", [8.0, -8.0])
def test_a_delay_on_a_path_is_measured_in_milliseconds(late_ms: float) -> None:
    t = np.cumsum(np.random.default_rng(5).uniform(0.3, 0.5, 300))
    rates = np.array([0.11, 0.17, 0.23, 0.29, 0.31, 0.37])

    def path(at: Real) -> Real:
        return np.asarray(np.sin(np.outer(at, rates) + np.arange(6)))

    late = path(t - late_ms / 1000.0)
    arm = random_arm(UR_LIKE, 5, **{f"j{i + 1}": lambda _, i=i: (late - path(t))[:, i] for i in range(6)})
    log = replace(arm.log(path(t), 5), t_s=t, approach=np.zeros((300, 6), dtype=np.int8))
    (effect,) = judged(arm.robot, with_guesses(log)).effects
    assert effect.label == "delay"
    assert effect.parameters[0].unit == "ms"
    assert effect.parameters[0].value == pytest.approx(late_ms, rel=0.1)


def test_rows_out_of_order_are_followed_in_time() -> None:
    """Sorted by an angle, but with the times: direction and lag come from the order of the times."""
    arm = random_arm(UR_LIKE, 6, j2=missing)
    log = arm.log(random_poses(6, 160, 6), 6)
    t = np.cumsum(np.random.default_rng(6).uniform(3.0, 5.0, 160))
    order = np.argsort(log.theta[:, 0])
    blank = replace(log, t_s=t, approach=np.zeros((160, 6), dtype=np.int8)).take(order)
    mixed = with_guesses(blank)
    assert mixed.approach == pytest.approx(log.approach[order])
    assert [effect.label for effect in judged(arm.robot, mixed).effects] == ["lag of joint 2"]
