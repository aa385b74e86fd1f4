"""The supported kinds of machine, each with its specific parts.

A further mechanism is a separate package and one entry in `KINDS` (docs/how-to/add-a-mechanism.md).
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
        """Tolerance of each zero offset."""
        ...


class AnyRobot(Protocol):
    """A robot file of any model."""

    @property
    def model(self) -> str:
        """`[robot] model` of its file."""
        ...

    @property
    def serial(self) -> str:
        """Serial of the robot."""
        ...

    @property
    def tolerances(self) -> HasZeroTolerance:
        """Standard deviations of the nominal values."""
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
    """The specific parts of one kind of machine."""

    robot: type[AnyRobot]
    """Its robot file."""
    mechanism: Callable[[Any, Measurements], AnyMechanism]
    """The robot with these readings."""
    columns: Callable[[Any], Columns]
    """The columns of its measurement file."""
    infers_columns: bool
    """Whether approach and position are inferred if a log does not record them."""
    catalogue: Callable[[Any], tuple[Effect, ...]]
    """Every effect at every place where it can act."""
    weak_direction: Callable[[Any, Solution, Real, float], WeakDirection]
    """From mechanism, solution, row_sd (R,) and sd_factor."""
    extent: Literal["workspace", "measured poses"]
    """The region over which its position error is predicted."""


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
    """Read a robot file of any model; None is the paper's five-bar.

    :raises InputRefused: the file is missing, is not TOML, or contains an invalid value; the error gives
    section and key.
    """
    if path is None:
        return Robot.default()
    return robot_of(read_sections(path), source=str(path))


def robot_of(data: Sections, *, source: str = "robot") -> AnyRobot:
    """A robot from its file's sections. :raises InputRefused: unknown model, or as for its robot file."""
    section = data.get("robot")
    model = section.get("model") if isinstance(section, dict) else None
    kind = KINDS.get(FIVE_BAR_MODEL if model is None else model) if isinstance(model, str | None) else None
    if kind is None:
        known = " and ".join(KINDS)
        raise InputRefused(f"{source}: [robot.model] {model!r} is not known; known are {known}.")
    return kind.robot.from_dict(data, source=source)


def kind_of(machine: AnyRobot | Mechanism) -> MachineKind:
    """The specific parts for a robot or a mechanism."""
    return KINDS[machine.model]


def effects_of(mechanism: Mechanism) -> tuple[Effect, ...]:
    """The catalogue of a machine: every effect at every place where it can act."""
    return kind_of(mechanism).catalogue(mechanism)


def mechanism_of(robot: AnyRobot, measurements: Measurements) -> AnyMechanism:
    """The robot with these readings."""
    return kind_of(robot).mechanism(robot, measurements)


def read_readings(
    robot: AnyRobot,
    path: Path,
    measured: Measured = "position",
    *,
    in_order: bool = True,
    mapping: ColumnMap | None = None,
) -> Measurements:
    """Read a measurement file of this robot; data missing in an arm's log are inferred and marked.

    :param measured: which measurement to use if a file contains both
    :param in_order: refuse decreasing times in a five-bar's file; otherwise the caller checks the column
    :param mapping: the column map of a foreign file
    :raises InputRefused: the file is malformed; the error gives row, column and remedy.
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
    earlier = np.flatnonzero(np.diff(readings.t_s) < 0.0) + 1
    if earlier.size:
        log.warning(
            "%s: t_s decreases at %d of %d rows, first at reading %s; the order of t_s is used, not that "
            "of the rows.",
            source,
            len(earlier),
            len(readings),
            readings.ids[int(earlier[0])],
        )
    return with_guesses(readings)


def _foreign(content: bytes, source: str, columns: Columns, mapping: ColumnMap | None) -> Measurements:
    """Convert to the contract's form first; readings with a lost target are excluded and counted."""
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
