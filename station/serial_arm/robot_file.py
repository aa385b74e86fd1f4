"""The robot file of a serial arm: Denavit-Hartenberg links, tolerances, measurement and uncertainty."""

from __future__ import annotations

from collections.abc import Sized
from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, ValidationError

from station.errors import InputRefused
from station.records import Columns, Finite, Positive, Section, Sections, refusal
from station.serial_arm.dh import Convention, Links

JointKind = Literal["revolute", "prismatic"]
Triple = tuple[float, float, float]
ARM_MODEL = "serial-dh"


@dataclass(frozen=True)
class ArmTolerances:
    """Standard deviations of the nominal values."""

    zero_offset_deg: float = 1.0
    length_mm: float = 1.0
    angle_deg: float = 0.5


@dataclass(frozen=True)
class Arm:
    """One serial arm under an instrument that follows a target on its tool."""

    model: ClassVar[str] = ARM_MODEL
    serial: str
    a: tuple[float, ...]
    d: tuple[float, ...]
    alpha_deg: tuple[float, ...]
    offset_deg: tuple[float, ...]
    convention: Convention = "standard"
    tolerances: ArmTolerances = field(default_factory=ArmTolerances)
    tool_mm: Triple = (0.0, 0.0, 0.0)
    tool_sd_mm: float = 300.0
    reading_sd_mm: float = 0.05
    """Standard uncertainty of one coordinate or distance: instrument and repeatability of the arm
    together."""
    joint_kinds: tuple[JointKind, ...] = ()
    """One per joint; by default all rotate."""
    gravity: Triple = (0.0, 0.0, -1.0)
    """Direction of gravity in the frame of the base."""

    @classmethod
    def from_dict(cls, data: Sections, *, source: str = "robot") -> Arm:
        """From the robot file's sections.  :raises InputRefused: the error gives section and key."""
        try:
            return ArmFile.model_validate(data).to_arm(source)
        except ValidationError as error:
            raise refusal(error, source) from error

    def to_json(self) -> Sections:
        """The sections of the robot file; `from_dict` reads them back."""
        t = self.tolerances
        return {
            "robot": {
                "serial": self.serial,
                "model": ARM_MODEL,
                "convention": self.convention,
                "a_mm": self.a,
                "d_mm": self.d,
                "alpha_deg": self.alpha_deg,
                "offset_deg": self.offset_deg,
                **({"joints": self.joint_kinds} if self.sliding else {}),
                "gravity": self.gravity,
                "tolerance": {
                    "zero_offset_deg": t.zero_offset_deg,
                    "length_mm": t.length_mm,
                    "angle_deg": t.angle_deg,
                },
            },
            "tool": {"position_mm": self.tool_mm, "sd_mm": self.tool_sd_mm},
            "instrument": {"sd_mm": self.reading_sd_mm},
        }

    @property
    def joints(self) -> int:
        return len(self.a)

    @property
    def sliding(self) -> tuple[int, ...]:
        """Joints that slide, counted from 1."""
        return tuple(i + 1 for i, kind in enumerate(self.joint_kinds) if kind == "prismatic")

    @property
    def links(self) -> Links:
        """Nominal links, mm and rad."""
        return Links(
            np.array(self.a),
            np.array(self.d),
            np.radians(self.alpha_deg),
            np.radians(self.offset_deg),
            self.convention,
            tuple(i - 1 for i in self.sliding),
        )

    @property
    def columns(self) -> Columns:
        """The columns of its measurement file."""
        return Columns(
            joints=self.joints,
            distance="range_mm",
            tracker=("tracker_x_mm", "tracker_y_mm", "tracker_z_mm"),
            either=True,
            time_ordered=False,
            sliding=self.sliding,
            more=("setup",),
        )


class _ToleranceSection(Section):
    zero_offset_deg: Positive = ArmTolerances.zero_offset_deg
    """Tolerance of each zero offset."""
    length_mm: Positive = ArmTolerances.length_mm
    """Tolerance of each length of a link."""
    angle_deg: Positive = ArmTolerances.angle_deg
    """Tolerance of each angle between links."""


class _RobotSection(Section):
    serial: Annotated[str, Field(min_length=1)] = "unnamed"
    """Serial number of the robot."""
    model: Literal["serial-dh"]
    """Kind of machine."""
    convention: Convention = "standard"
    """Order of the Denavit-Hartenberg steps: theta and d first, or `modified` (Craig)."""
    a_mm: Annotated[list[Finite], Field(min_length=2)]
    """Link lengths, one per joint."""
    d_mm: list[Finite]
    """Link offsets, one per joint."""
    alpha_deg: list[Finite]
    """Link twists, one per joint."""
    offset_deg: list[Finite] | None = None
    """Joint angles at the zeros of the drives; by default 0."""
    joints: list[JointKind] | None = None
    """Type of each joint: `revolute` (the default) or `prismatic`, which moves along z."""
    gravity: tuple[Finite, Finite, Finite] = Arm.gravity
    """Direction of gravity in the frame of the base."""
    tolerance: _ToleranceSection = _ToleranceSection()


class _ToolSection(Section):
    position_mm: tuple[Finite, Finite, Finite] = Arm.tool_mm
    """Position of the target in the frame of the last link."""
    sd_mm: Positive = Arm.tool_sd_mm
    """Standard uncertainty of this position."""


class _InstrumentSection(Section):
    sd_mm: Positive = Arm.reading_sd_mm
    """Standard uncertainty of one coordinate or distance: instrument and repeatability of the arm
    together."""


class ArmFile(Section):
    """The sections of a serial arm's robot file."""

    robot: _RobotSection
    tool: _ToolSection = _ToolSection()
    instrument: _InstrumentSection = _InstrumentSection()

    def to_arm(self, source: str) -> Arm:
        """:raises InputRefused: the lists have different lengths."""
        robot = self.robot
        joints = len(robot.a_mm)
        offset = robot.offset_deg if robot.offset_deg is not None else [0.0] * joints
        kinds = robot.joints or ["revolute"] * joints
        lists: tuple[tuple[str, Sized], ...] = (
            ("d_mm", robot.d_mm),
            ("alpha_deg", robot.alpha_deg),
            ("offset_deg", offset),
            ("joints", kinds),
        )
        for name, values in lists:
            if len(values) != joints:
                raise InputRefused(
                    f"{source}: [robot.{name}] has {len(values)} values where a_mm has {joints}; "
                    "give one a joint."
                )
        return Arm(
            serial=robot.serial,
            a=tuple(robot.a_mm),
            d=tuple(robot.d_mm),
            alpha_deg=tuple(robot.alpha_deg),
            offset_deg=tuple(offset),
            convention=robot.convention,
            tolerances=ArmTolerances(**robot.tolerance.model_dump()),
            tool_mm=self.tool.position_mm,
            tool_sd_mm=self.tool.sd_mm,
            reading_sd_mm=self.instrument.sd_mm,
            joint_kinds=tuple(kinds),
            gravity=robot.gravity,
        )
