"""The serial arm: Denavit-Hartenberg links with six errors each, and its robot file."""

from __future__ import annotations

from station.serial_arm.mechanism import SerialArm
from station.serial_arm.robot_file import ARM_MODEL, Arm, ArmFile
from station.serial_arm.urdf import arm_from_urdf

__all__ = [
    "ARM_MODEL",
    "Arm",
    "ArmFile",
    "SerialArm",
    "arm_from_urdf",
]
