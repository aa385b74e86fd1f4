"""The machines that the station knows: their robot files, and the mechanism that identification works on."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from station.effects import Effect, arm_catalogue, five_bar_catalogue
from station.errors import InputRefused
from station.five_bar import FIVE_BAR_MODEL, FiveBar, Robot, read_sections
from station.mechanism import Mechanism
from station.records import FIVE_BAR, Columns, Measurements, read_measurements, with_guesses
from station.serial_arm import ARM_MODEL, Arm, SerialArm

AnyRobot = Robot | Arm
AnyMechanism = FiveBar | SerialArm
Measured = Literal["position", "range"]


def read_robot(path: Path | None) -> AnyRobot:
    """A robot file of any model; None is the paper's five-bar.

    :raises InputRefused: missing, not TOML, or a value out of place, with the section and key.
    """
    if path is None:
        return Robot.default()
    return robot_of(read_sections(path), source=str(path))


def robot_of(data: dict[str, Any], *, source: str = "robot") -> AnyRobot:
    """From a robot file's sections.  :raises InputRefused:"""
    section = data.get("robot")
    model = section.get("model") if isinstance(section, dict) else None
    if model == ARM_MODEL:
        return Arm.from_dict(data, source=source)
    if model not in (None, FIVE_BAR_MODEL):
        raise InputRefused(
            f"{source}: [robot.model] {model!r} is not known; known are {FIVE_BAR_MODEL} and {ARM_MODEL}."
        )
    return Robot.from_dict(data, source=source)


def columns_of(robot: AnyRobot) -> Columns:
    """What a measurement file of this robot holds."""
    return robot.columns if isinstance(robot, Arm) else FIVE_BAR


def read_readings(robot: AnyRobot, path: Path, measured: Measured = "position") -> Measurements:
    """A measurement file of this robot; of an arm's log what it does not record is guessed and marked.

    measured: which of an arm's columns count where a file has both.

    :raises InputRefused: anything malformed, with row, column and what to do.
    """
    readings = read_measurements(path, columns_of(robot))
    if not isinstance(robot, Arm):
        return readings
    if measured == "range":
        if np.isnan(readings.distance).any():
            raise InputRefused(f"{path.name}: row 1: column range_mm is missing; distances were asked for.")
        readings = replace(readings, tracker=None)
    return with_guesses(readings)


def mechanism_of(robot: AnyRobot, measurements: Measurements) -> AnyMechanism:
    """The robot under these readings."""
    return SerialArm(robot, measurements) if isinstance(robot, Arm) else FiveBar(robot, measurements)


def effects_of(mechanism: Mechanism) -> tuple[Effect, ...]:
    """The catalogue of a machine: every effect at every place where it can act."""
    if isinstance(mechanism, SerialArm):
        return arm_catalogue(mechanism.robot.joints, by_range=mechanism.by_range)
    return five_bar_catalogue()
