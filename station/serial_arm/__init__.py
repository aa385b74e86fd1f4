"""The serial arm: Denavit-Hartenberg links with six errors each, and its robot file."""

from __future__ import annotations

from station.serial_arm.mechanism import SerialArm
from station.serial_arm.robot_file import ARM_MODEL, Arm, ArmFile

__all__ = [
    "ARM_MODEL",
    "Arm",
    "ArmFile",
    "SerialArm",
]
