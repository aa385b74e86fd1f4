"""Distance of a point from the workspace of the robot file."""

from __future__ import annotations

import numpy as np

from station.five_bar.robot_file import Robot
from station.records import Complex, Real


def excess_mm(robot: Robot, places: Complex) -> Real:
    """(K,) distance of positions (K,) outside the workspace; negative inside."""
    (left, right), (low, high) = robot.workspace_x, robot.workspace_y
    x, y = places.real, places.imag
    return np.asarray(np.maximum.reduce([left - x, x - right, low - y, y - high]))
