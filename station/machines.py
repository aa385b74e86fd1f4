"""The kinds of machine that the station knows, each with everything that belongs to it alone.

A further mechanism is a package of its own and one entry in `KINDS` (docs/how-to/add-a-mechanism.md).
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, Protocol, Self

import numpy as np

from station.effects import Effect, arm_catalogue, five_bar_catalogue
from station.errors import InputRefused
from station.fitting import Solution, describe_separability
from station.five_bar import FIVE_BAR_MODEL, FiveBar, Robot, describe_weak_direction, read_sections
from station.mechanism import Mechanism, reference_of
from station.records import (
    FIVE_BAR,
    TIME,
    ColumnMap,
    Columns,
    Measured,
    Measurements,
    Real,
    Sections,
    WeakDirection,
    content_of,
    parse_measurements,
    translated,
    with_guesses,
)
from station.serial_arm import ARM_MODEL, Arm, SerialArm


class HasZeroTolerance(Protocol):
    """Tolerances of any kind of machine."""

    @property
    def zero_offset_deg(self) -> float:
        """Of each zero offset."""
        ...


class AnyRobot(Protocol):
    """A robot file of any model."""

    @property
    def model(self) -> str:
        """`[robot] model` of its file."""
        ...

    @property
    def serial(self) -> str:
        """Of the robot."""
        ...

    @property
    def tolerances(self) -> HasZeroTolerance:
        """Standard deviations of what is not known better."""
        ...

    @classmethod
    def from_dict(cls, data: Sections, *, source: str = "robot") -> Self:
        """From the sections of a robot file.  :raises InputRefused:"""
        ...

    def to_json(self) -> Sections:
        """The sections of its file; `from_dict` reads them back."""
        ...


log = logging.getLogger(__name__)

AnyMechanism = Mechanism


@dataclass(frozen=True)
class MachineKind:
    """What is particular to one kind of machine."""

    robot: type[AnyRobot]
    """Its robot file."""
    mechanism: Callable[[Any, Measurements], AnyMechanism]
    """The robot under these readings."""
    columns: Callable[[Any], Columns]
    """What its measurement file holds."""
    infers_columns: bool
    """Whether approach and position are inferred where a log does not record them."""
    catalogue: Callable[[Any], tuple[Effect, ...]]
    """Every effect at every place where it can act."""
    weak_direction: Callable[[Any, Solution, Real, float], WeakDirection]
    """From mechanism, solution, row_sd (R,) and sd_factor."""
    extent: Literal["workspace", "measured poses"]
    """Over what its position error is predicted."""


KINDS: dict[str, MachineKind] = {
    FIVE_BAR_MODEL: MachineKind(
        robot=Robot,
        mechanism=FiveBar,
        columns=lambda _: FIVE_BAR,
        infers_columns=False,
        catalogue=lambda _: five_bar_catalogue(),
        weak_direction=describe_weak_direction,
        extent="workspace",
    ),
    ARM_MODEL: MachineKind(
        robot=Arm,
        mechanism=SerialArm,
        columns=lambda arm: arm.columns,
        infers_columns=True,
        catalogue=lambda arm: arm_catalogue(
            arm.robot.joints,
            by_range=arm.by_range,
            sliding=arm.robot.sliding,
            timed=TIME not in arm.measurements.guessed,
            warmed=reference_of(arm.measurements).temperature_c is not None,
        ),
        weak_direction=describe_separability,
        extent="measured poses",
    ),
}
"""By `model` of the robot file."""


def read_robot(path: Path | None) -> AnyRobot:
    """A robot file of any model; None is the paper's five-bar.

    :raises InputRefused: missing, not TOML, or a value out of place, with the section and key.
    """
    if path is None:
        return Robot.default()
    return robot_of(read_sections(path), source=str(path))


def robot_of(data: Sections, *, source: str = "robot") -> AnyRobot:
    """From a robot file's sections.  :raises InputRefused: an unknown model, or as the robot's own file."""
    section = data.get("robot")
    model = section.get("model") if isinstance(section, dict) else None
    kind = KINDS.get(FIVE_BAR_MODEL if model is None else model) if isinstance(model, str | None) else None
    if kind is None:
        known = " and ".join(KINDS)
        raise InputRefused(f"{source}: [robot.model] {model!r} is not known; known are {known}.")
    return kind.robot.from_dict(data, source=source)


def kind_of(machine: AnyRobot | Mechanism) -> MachineKind:
    """What is particular to a robot or a mechanism."""
    return KINDS[machine.model]


def effects_of(mechanism: Mechanism) -> tuple[Effect, ...]:
    """The catalogue of a machine: every effect at every place where it can act."""
    return kind_of(mechanism).catalogue(mechanism)


def mechanism_of(robot: AnyRobot, measurements: Measurements) -> AnyMechanism:
    """The robot under these readings."""
    return kind_of(robot).mechanism(robot, measurements)


def read_readings(
    robot: AnyRobot,
    path: Path,
    measured: Measured = "position",
    *,
    in_order: bool = True,
    mapping: ColumnMap | None = None,
) -> Measurements:
    """A measurement file of this robot; what an arm's log does not record is inferred and marked.

    measured: which of the columns count where a file has both.
    in_order: refuse a five-bar's file whose time runs backwards; else the caller judges the column.
    mapping: which columns are which, where the file was not made for this program.

    :raises InputRefused: anything malformed, with row, column and what to do.
    """
    return read_log(robot, content_of(path), path.name, measured, in_order=in_order, mapping=mapping)


def read_log(
    robot: AnyRobot,
    content: bytes,
    source: str,
    measured: Measured = "position",
    *,
    in_order: bool = True,
    mapping: ColumnMap | None = None,
) -> Measurements:
    """The same from the file's bytes.  :raises InputRefused: as `read_readings`."""
    kind = kind_of(robot)
    columns = kind.columns(robot)
    if not in_order:
        columns = replace(columns, time_ordered=False)
    if mapping is None and not kind.infers_columns:
        return parse_measurements(content, columns, source=source)
    readings = _foreign(content, source, columns, mapping)
    if not kind.infers_columns:
        return readings
    if measured == "range":
        if np.isnan(readings.distance).any():
            raise InputRefused(f"{source}: row 1: column range_mm is missing; distances were asked for.")
        readings = replace(readings, tracker=None)
    return with_guesses(readings)


def _foreign(content: bytes, source: str, columns: Columns, mapping: ColumnMap | None) -> Measurements:
    """By way of the contract's form; readings whose target was lost are left out and counted."""
    read = translated(content, mapping, columns, source)
    if read.lost:
        log.warning(
            "%s: %d readings are left out: the instrument had lost its target there.", source, read.lost
        )
    if not set(columns.theta) & set(read.names):
        raise InputRefused(
            f"{source}: none of the columns {', '.join(columns.theta)} is there; `station columns "
            f"{source}` proposes a column map for files made elsewhere, to be given with --columns."
        )
    return parse_measurements(read.content, columns, source=source)
