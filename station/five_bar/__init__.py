"""The five-bar robot with its mechanism: kinematics, error model, robot file (paper, sections 2 and 3)."""

from __future__ import annotations

from station.five_bar.error_model import (
    KEPT,
    NAMES,
    SIZE,
    Pose,
    distance_by_joint,
    distance_jacobian,
    perturbed,
    pose,
    position_jacobian,
)
from station.five_bar.kinematics import HOME, Geometry, Unreachable, elbows, forward, inverse
from station.five_bar.mechanism import GRID, SCALE_SD_MM, FiveBar, lengths, load, pull
from station.five_bar.plausibility import check_distances, check_places, check_poses
from station.five_bar.references import measured_value, with_references
from station.five_bar.robot_file import (
    FIVE_BAR_MODEL,
    FRESH_INSET_MM,
    INSET_MM,
    MOST_ZERO_OFFSET,
    Robot,
    RobotFile,
    Tolerances,
    read_sections,
)
from station.five_bar.weak_direction import (
    KNOWN_DRM_SD_MM,
    SECOND_MOUNT_MM,
    common_sd_deg,
    describe_weak_direction,
    with_second_mount,
)
from station.five_bar.workspace import excess_mm

__all__ = [
    "FIVE_BAR_MODEL",
    "FRESH_INSET_MM",
    "GRID",
    "HOME",
    "INSET_MM",
    "KEPT",
    "KNOWN_DRM_SD_MM",
    "MOST_ZERO_OFFSET",
    "NAMES",
    "SCALE_SD_MM",
    "SECOND_MOUNT_MM",
    "SIZE",
    "FiveBar",
    "Geometry",
    "Pose",
    "Robot",
    "RobotFile",
    "Tolerances",
    "Unreachable",
    "check_distances",
    "check_places",
    "check_poses",
    "common_sd_deg",
    "describe_weak_direction",
    "distance_by_joint",
    "distance_jacobian",
    "elbows",
    "excess_mm",
    "forward",
    "inverse",
    "lengths",
    "load",
    "measured_value",
    "perturbed",
    "pose",
    "position_jacobian",
    "pull",
    "read_sections",
    "with_references",
    "with_second_mount",
]
