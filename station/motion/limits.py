"""The permitted positions of the machine: checked on numbers alone, before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from station.errors import StepFailed
from station.five_bar import Robot, Unreachable, excess_mm, forward
from station.records import Angles, Stop
from station.settings import JointSettings, LimitSettings

_POINTS_PER_LEG = 16


def outside_text(robot: Robot, place: complex, margin_mm: float) -> str:
    """Empty if a position is within the workspace and its margin, otherwise its distance outside."""
    excess = float(excess_mm(robot, np.array([place]))[0])
    if excess <= margin_mm:
        return ""
    return (
        f"({place.real:.1f}, {place.imag:.1f}) mm is {excess:.1f} mm outside the workspace,"
        f" {margin_mm:g} mm is allowed"
    )


def check_way(
    robot: Robot,
    joints: Sequence[JointSettings],
    limits: LimitSettings,
    stop: Stop,
    way: Sequence[Angles],
) -> None:
    """Check the stop, every joint command after the first point of `way`, and the motion between them.

    :raises StepFailed: naming the stop and the limit.
    """
    if reason := outside_text(robot, complex(*stop.target_mm), limits.workspace_margin_mm):
        raise StepFailed(f"Position {stop.position} is refused: {reason}.")
    for joint, settings in enumerate(joints):
        for target in way[1:]:
            if not abs(target[joint] - settings.zero_at_deg) <= settings.reach_deg:
                raise StepFailed(
                    f"Position {stop.position} is refused: joint {joint + 1} would go to {target[joint]:.3f}"
                    f" deg, {settings.reach_deg:g} deg about {settings.zero_at_deg:g} are allowed."
                )
    line = np.concatenate([np.linspace(start, end, _POINTS_PER_LEG) for start, end in pairwise(way)])
    try:
        path = forward(robot.geometry, np.radians(line))
    except Unreachable as error:
        raise StepFailed(f"The way to position {stop.position} is refused: {error}") from error
    worst = complex(path[np.argmax(excess_mm(robot, path))])
    if reason := outside_text(robot, worst, limits.swing_mm):
        raise StepFailed(f"The way to position {stop.position} is refused: {reason}.")
