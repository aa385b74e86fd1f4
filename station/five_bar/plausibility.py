"""Readings that are impossible for this robot: wrong units, exchanged columns, rows of another pose.

A refusal names the reading and the column.
"""

from __future__ import annotations

import numpy as np

from station.errors import InputRefused
from station.five_bar.kinematics import Unreachable, forward, inverse
from station.five_bar.robot_file import Robot
from station.records import Measurements

ZERO_OFFSETS = 5.0
"""Zero offsets beyond this many tolerances count as a mistake."""
OUTSIDE_MM = 80.0
"""Distance of the platform outside the workspace that zero offsets of a few degrees cannot explain."""
MISMATCH_MM = 100.0
"""Deviation of a distance from the joint angles, without the common offset, that they cannot explain."""
FEWEST_PLACES = 5
"""Four unknowns and the reading offset (paper, section 5)."""


def check_poses(robot: Robot, measurements: Measurements) -> None:
    """:raises InputRefused: naming the first reading whose angles or distance are impossible."""
    theta = measurements.theta
    if np.abs(np.degrees(theta)).max() < 2.0 * np.pi:
        raise InputRefused(
            f"Reading {measurements.ids[0]}, columns theta1_deg and theta2_deg: "
            "the angles look like radians; give degrees."
        )
    _check_joint_ranges(robot, measurements)
    try:
        r = forward(robot.geometry, theta)
    except Unreachable as error:
        raise _refusal(measurements, int(error.indices[0]), str(error)) from error
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    dx = np.maximum(np.maximum(x0 - r.real, r.real - x1), 0.0)
    dy = np.maximum(np.maximum(y0 - r.imag, r.imag - y1), 0.0)
    outside = np.hypot(dx, dy)
    if outside.max() > OUTSIDE_MM:
        k = int(np.argmax(outside > OUTSIDE_MM))
        raise _refusal(
            measurements, k, f"the platform would stand {outside[k]:.0f} mm outside the workspace."
        )


def _check_joint_ranges(robot: Robot, measurements: Measurements) -> None:
    reach = np.degrees(inverse(robot.geometry, robot.workspace_grid(9, 5)))
    room = ZERO_OFFSETS * robot.tolerances.zero_offset_deg
    low, high = reach.min(axis=0) - room, reach.max(axis=0) + room
    degrees = np.degrees(measurements.theta)
    bad = np.argwhere((degrees < low) | (degrees > high))
    if len(bad):
        k, i = (int(v) for v in bad[0])
        raise InputRefused(
            f"Reading {measurements.ids[k]}, column theta{i + 1}_deg: {degrees[k, i]:.1f} deg is beyond "
            f"what the workspace needs, joint {i + 1} from {low[i]:.0f} to {high[i]:.0f} deg. "
            "Check unit, sign and order of the joints and the robot file."
        )


def check_distances(robot: Robot, measurements: Measurements) -> None:
    """:raises InputRefused: naming the reading whose distance cannot belong to its joint angles."""
    for mount in range(len(measurements.mounts)):
        c = robot.mount_of(measurements.mounts[mount])
        if c is None:
            if mount:
                continue  # the position of this mount is left to the identification
            c = robot.c
        own = np.flatnonzero(measurements.mount == mount)
        if not len(own):
            continue  # fresh readings of one mount beside a fit to several
        foot = complex(*c) + complex(*robot.d)
        nominal = np.abs(forward(robot.geometry, measurements.theta[own]) - foot)
        apart = measurements.distance[own] - nominal
        apart -= np.median(apart)
        if np.abs(apart).max() > MISMATCH_MM:
            k = int(np.argmax(np.abs(apart)))
            raise InputRefused(
                f"Reading {measurements.ids[own[k]]}, column scale_mm: the distance is "
                f"{abs(apart[k]):.0f} mm off what its joint angles say, compared with the other readings; "
                "check that the row is in its place."
            )


def check_places(measurements: Measurements) -> None:
    """:raises InputRefused: there are too few distinct positions."""
    places = len(set(map(tuple, np.round(np.degrees(measurements.theta), 1).tolist())))
    if places < FEWEST_PLACES:
        raise InputRefused(
            f"Only {places} different places were measured; at least {FEWEST_PLACES} are needed "
            "(paper, section 5)."
        )


def _refusal(measurements: Measurements, k: int, text: str) -> InputRefused:
    return InputRefused(
        f"Reading {measurements.ids[k]}, columns theta1_deg and theta2_deg: {text} "
        "Check unit, sign and order of the joints and the robot file."
    )
