"""The way back into the workspace, on numbers alone."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.errors import StepFailed
from station.five_bar import Robot
from station.motion.way_back import INSET_MM, outside_mm, way_back

ROBOT = Robot.default()
HOME_DEG = (0.0, 180.0)


def test_an_arm_inside_stays_where_it_is() -> None:
    assert outside_mm(ROBOT, HOME_DEG) < 0.0
    assert way_back(ROBOT, HOME_DEG) == []


@given(st.floats(-60.0, 60.0), st.floats(120.0, 240.0))
def test_every_step_reduces_the_distance(theta1_deg: float, theta2_deg: float) -> None:
    """From wherever the reach of the joints allows, or it is said that no way is known."""
    start = (theta1_deg, theta2_deg)
    try:
        way = way_back(ROBOT, start)
    except StepFailed as refusal:
        assert "by hand" in str(refusal)
        return
    distances = [outside_mm(ROBOT, angles) for angles in (start, *way)]
    if way:
        assert distances[-1] == pytest.approx(-INSET_MM, abs=5.0) and distances[-1] <= -INSET_MM + 1e-3
    else:
        assert distances[0] <= 0.0
    for before, after in pairwise(distances):
        assert after < before or math.isinf(after)
    for before_deg, after_deg in pairwise((start, *way)):
        assert max(abs(b - a) for a, b in zip(before_deg, after_deg, strict=True)) < 5.0


def test_a_way_is_known_from_almost_everywhere() -> None:
    """A grid over the reach of both joints: how often the drives have to be switched off."""
    grid = [(a, b) for a in range(-60, 61, 10) for b in range(120, 241, 10)]
    stranded = []
    for start in grid:
        try:
            way_back(ROBOT, start)
        except StepFailed:
            stranded.append(start)
    assert stranded == []
