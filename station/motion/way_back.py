"""A path back into the workspace from any position of the arm, planned on numbers alone.

Straight towards the nearest position inside, or with both joints directly towards it or towards the middle:
the first of these on which the distance to the workspace decreases continuously.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from station.errors import StepFailed
from station.five_bar import Robot, Unreachable, elbows, excess_mm, forward, inverse
from station.records import Angles, Real

INSET_MM = 5.0
"""How far inside the workspace the path ends."""
TOLERANCE_MM = 2.0
"""Allowed increase of the distance from one step to the next, for the position error of a servo."""
_STEP_MM = 5.0
_STEP_DEG = 1.0
_SAME_DEG = 0.01
_NOT_CLOSED_MM = 1000.0


def outside_mm(robot: Robot, theta_deg: Angles) -> float:
    """Distance of P outside the workspace, negative inside; inf if the linkage does not close."""
    try:
        place = forward(robot.geometry, np.radians(np.array([theta_deg])))
    except Unreachable:
        return math.inf
    return float(excess_mm(robot, place)[0])


def way_back(robot: Robot, theta_deg: Angles) -> list[Angles]:
    """Joint angles of the path, the last `INSET_MM` inside; empty if the arm is inside.

    :raises StepFailed: no path is known on which the distance decreases continuously.
    """
    if outside_mm(robot, theta_deg) <= 0.0:
        return []
    for angles in _ways(robot, theta_deg):
        distances = _distances(robot, np.vstack([[theta_deg], angles]))
        arrived = np.flatnonzero(distances <= -INSET_MM + 1e-6)
        if arrived.size and np.all(np.diff(distances[: arrived[0] + 1]) < 0.0):
            return [(float(first), float(second)) for first, second in angles[: arrived[0]]]
    raise StepFailed(
        "No way back into the workspace is known from where the arm stands; switch the drives off and move it"
        " by hand."
    )


def _ways(robot: Robot, theta_deg: Angles) -> Iterator[Real]:
    start = np.array(theta_deg)
    (left, right), (low, high) = robot.workspace_x, robot.workspace_y
    goals = [complex((left + right) / 2, (low + high) / 2)]
    if math.isfinite(outside_mm(robot, theta_deg)):
        place = complex(forward(robot.geometry, np.radians(start[None]))[0])
        nearest = complex(
            np.clip(place.real, left + INSET_MM, right - INSET_MM),
            np.clip(place.imag, low + INSET_MM, high - INSET_MM),
        )
        goals.insert(0, nearest)
        line = place + (nearest - place) * _fractions(abs(nearest - place) / _STEP_MM)
        try:
            angles = np.degrees(inverse(robot.geometry, np.concatenate([[place], line])))
        except Unreachable:
            pass
        else:
            if np.max(np.abs(angles[0] - start)) < _SAME_DEG:  # otherwise an elbow is on its other side
                yield angles[1:]
    for goal in goals:
        end = np.degrees(inverse(robot.geometry, np.array([goal])))[0]
        yield start + (end - start) * _fractions(np.max(np.abs(end - start)) / _STEP_DEG)[:, None]


def _fractions(steps: float) -> Real:
    """Fractions of the path, (K,), without its start."""
    return np.linspace(0.0, 1.0, max(1, math.ceil(steps)) + 1)[1:]


def _distances(robot: Robot, theta_deg: Real) -> Real:
    """(K,) distance from the workspace, mm; if the linkage does not close, that from closing, and more."""
    out = []
    for angles in theta_deg:
        outside = outside_mm(robot, (float(angles[0]), float(angles[1])))
        if not math.isfinite(outside):
            B = elbows(robot.geometry, np.radians(angles[None]))[0]
            outside = _NOT_CLOSED_MM + abs(B[0] - B[1])
        out.append(outside)
    return np.array(out)
