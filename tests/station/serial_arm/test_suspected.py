"""A log that does not belong to the arm: the single wrong entry is named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from station.errors import InputRefused
from station.identification import identify
from station.records import Measurements
from station.studies.arms.physics import CRAIG_SEVEN, UR_LIKE, random_arm, random_poses


def measured(m: Measurements, factor: float = 1.0, by: int = 0) -> Measurements:
    assert m.tracker is not None
    return replace(m, tracker=np.roll(m.tracker * factor, by, axis=0), distance=m.distance * factor)


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (
            lambda m: replace(m, theta=m.theta * np.array([1, 1, -1, 1, 1, 1])),
            "With the sign of joint 3 reversed",
        ),
        (lambda m: replace(m, theta=m.theta[:, [0, 1, 3, 2, 4, 5]]), "With joints 3 and 4 exchanged"),
        (lambda m: measured(m, 1 / 25.4), "With the readings in inches"),
        (lambda m: measured(m, by=1), "With the readings of the row below"),
        (lambda m: measured(m, by=-1), "With the readings of the row above"),
    ],
    ids=["sign", "order", "inches", "below", "above"],
)
def test_the_wrong_entry_is_named(spoil: Callable[[Measurements], Measurements], said: str) -> None:
    arm = random_arm(UR_LIKE, 21)
    log = spoil(arm.log(random_poses(6, 60, 21), 21))
    with pytest.raises(InputRefused, match=rf"do not belong together: .* {said}, they agree to [\d.]+ mm"):
        identify(arm.robot, log)


def test_the_other_convention_is_named() -> None:
    arm = random_arm(CRAIG_SEVEN, 22)
    with pytest.raises(InputRefused, match="With the modified convention in the robot file"):
        identify(replace(arm.robot, convention="standard"), arm.log(random_poses(7, 60, 22), 22))


def test_two_wrong_entries_are_not_guessed() -> None:
    arm = random_arm(UR_LIKE, 23)
    log = arm.log(random_poses(6, 60, 23), 23)
    with pytest.raises(InputRefused, match="check the robot file"):
        identify(arm.robot, replace(log, theta=log.theta * np.array([1, -1, -1, 1, 1, 1])))
