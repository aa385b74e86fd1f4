"""The robot file: nominal geometry, tolerances, measuring mechanism, workspace, joints.

Planar vectors are complex numbers x + iy (mm), so the paper's rotation Q of eq. 10 is a
multiplication by i and a unit vector u(theta) is exp(i theta).

| symbol | attribute | unit | paper |
|---|---|---|---|
| e_i | `e` | mm | eq. 1, Table 1 |
| L_i, l_i | `L`, `l` | mm | eq. 1, Table 1 |
| c, d | `c`, `d` | mm | eq. 4, Fig. 4 (signs: docs/explanation/method.md) |
| dr_M | `drm`, `drm_sd` | mm | eq. 17 |
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, ValidationError

from drivers.scaling import JointScaling
from station.errors import InputRefused
from station.five_bar.kinematics import Geometry, Unreachable, inverse
from station.records import (
    AnyReference,
    Complex,
    Finite,
    JointAngle,
    MountingError,
    Positive,
    Section,
    Sections,
    checked_serial,
    content_of,
    refusal,
    sections_of_toml,
)

Pair = tuple[float, float]
FIVE_BAR_MODEL = "five-bar"
INSET_MM = 4.0
"""Margin from the workspace's edge for measured positions, for the overshoot of an approach."""
MOST_ZERO_OFFSET = 4.0
"""Maximum zero offset, in tolerances."""
MOST_MOUNTING_SDS = 20.0
"""Maximum mounting error, in standard deviations; more is a wrong entry."""
LEAST_REFERENCE_SD = 1e-5
"""Smallest standard uncertainty of a reference, deg or mm: no instrument of a plant measures better."""
SECOND = "second"
ASIDE_MM = 200.0
"""Displacement of the second mounting point, if the robot file does not define one."""
FRESH_INSET_MM = 15.0
"""Margin from the edge for fresh positions, which are predicted: the fit is most certain in the interior."""


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Standard deviations of the nominal values."""

    e_mm: float = 0.03
    link_mm: float = 0.03
    zero_offset_deg: float = 3.0


@dataclass(frozen=True)
class Robot:
    """One robot with its mechanism, as in its file; without a file, the paper's Table 1."""

    model: ClassVar[str] = FIVE_BAR_MODEL
    serial: str
    e: tuple[Pair, Pair] = ((80.0, 0.0), (-80.0, 0.0))
    L: Pair = (375.0, 375.0)
    l: Pair = (825.0, 825.0)  # noqa: E741
    c: Pair = (0.0, -79.0)
    d: Pair = (0.0, -51.0)
    drm: Pair = (1.0, 0.5)
    """Expected MAEMM ("about 1 mm and 0.5 mm", paper section 6.1)."""
    drm_sd: Pair = (0.2, 0.2)
    """Standard deviation of the MAEMM: "roughly measured", and within 0.16 mm of the result in Table 8."""
    mounts: dict[str, Pair] = field(default_factory=dict, hash=False)
    """c of further mounting points of the mechanism, by the `mount` id of the measurement file."""
    references: tuple[AnyReference, ...] = ()
    """Measurements of the mechanism and, in one run, of the joints, by other instruments."""
    type: str | None = None
    """Type designation: robots of one type share a prior and are evaluated together; None: alone."""
    accuracy_mm: float | None = None
    """Required accuracy of a calibration: largest position error; None if not specified."""
    tolerances: Tolerances = field(default_factory=Tolerances)
    workspace_x: Pair = (-240.0, 240.0)
    workspace_y: Pair = (-782.0, -632.0)
    counts_per_rev: int = 10_000
    ratio: float = 20.0
    zero_at_deg: Pair = (0.0, 180.0)
    sign: tuple[int, int] = (1, 1)
    feedback_sd_deg: float | None = None
    """Uncertainty of a joint's true angle from feedback; None is the unresolved part of one pulse."""

    @classmethod
    def default(cls, serial: str = "unnamed") -> Robot:
        """The paper's Table 1."""
        return cls(serial=serial)

    @classmethod
    def from_toml(cls, path: Path) -> Robot:
        """Read a robot file.

        :raises InputRefused: the file is missing, is not TOML, or contains an invalid value; the error gives
        section and key.
        """
        robot = cls.from_dict(read_sections(path), source=str(path))
        checked_serial(robot.serial)
        return robot

    @classmethod
    def from_dict(cls, data: Sections, *, source: str = "robot") -> Robot:
        """From the robot file's sections (also those in the store). :raises InputRefused:"""
        try:
            content = RobotFile.model_validate(data)
        except ValidationError as error:
            raise refusal(error, source) from error
        return content.to_robot(source)

    def to_json(self) -> Sections:
        """The sections of the robot file; `from_dict` reads them back."""
        # missing values are omitted: the file of a robot without them is unchanged
        references = [r.model_dump() for r in self.references if isinstance(r, MountingError)]
        return {
            "robot": {
                "serial": self.serial,
                **({} if self.type is None else {"type": self.type}),
                **({} if self.accuracy_mm is None else {"accuracy_mm": self.accuracy_mm}),
                "e": self.e,
                "L": self.L,
                "l": self.l,
                "tolerance": {
                    "e_mm": self.tolerances.e_mm,
                    "link_mm": self.tolerances.link_mm,
                    "zero_offset_deg": self.tolerances.zero_offset_deg,
                },
            },
            "mechanism": {
                "c": self.c,
                "d": self.d,
                "drm_mm": self.drm,
                "drm_sd_mm": self.drm_sd,
                "mounts": self.mounts,
                **({"reference": references} if references else {}),
            },
            "workspace": {"x": self.workspace_x, "y": self.workspace_y},
            "joints": {
                "counts_per_rev": self.counts_per_rev,
                "ratio": self.ratio,
                "zero_at_deg": self.zero_at_deg,
                "sign": self.sign,
                **({} if self.feedback_sd_deg is None else {"feedback_sd_deg": self.feedback_sd_deg}),
            },
        }

    @property
    def geometry(self) -> Geometry:
        """Nominal geometry."""
        return Geometry(
            e=np.array([complex(*centre) for centre in self.e]),
            L=np.array(self.L),
            l=np.array(self.l),
            cd=complex(*self.c) + complex(*self.d),
        )

    def scaling(self, joint: int) -> JointScaling:
        """Pulses to angle of joint 1 or 2."""
        i = joint - 1
        return JointScaling(self.counts_per_rev, self.ratio, self.zero_at_deg[i], self.sign[i])

    def mount_of(self, label: str) -> Pair | None:
        """c of a mounting point; None if unknown."""
        if not label:
            return self.c
        return self.mounts.get(label, self.second_mount[1] if label == SECOND else None)

    @property
    def second_mount(self) -> tuple[str, Pair]:
        """Label and c of the mounting point that plan `two_mounts` uses beside the first one.

        The first one of the robot file, otherwise one displaced by `ASIDE_MM`.
        """
        for label, c in self.mounts.items():
            return label, c
        return SECOND, (self.c[0] + ASIDE_MM, self.c[1])

    @property
    def pulse_deg(self) -> float:
        """One pulse at the joint, degrees."""
        return 360.0 / (self.counts_per_rev * self.ratio)

    @property
    def joint_sd_deg(self) -> float:
        """Standard deviation of a joint angle read from feedback; by default that of a uniform pulse."""
        return self.pulse_deg / math.sqrt(12.0) if self.feedback_sd_deg is None else self.feedback_sd_deg

    def workspace_grid(self, nx: int, ny: int) -> Complex:
        """(nx * ny,) evenly spaced points of the workspace, its edges included."""
        return _grid(self.workspace_x, self.workspace_y, nx, ny)

    def informed(self, references: Sequence[AnyReference]) -> Robot:
        """The same robot, with references for one run in addition to those of its file.

        :raises InputRefused: a reference exceeds its tolerance.
        """
        for reference in references:
            if isinstance(reference, JointAngle):
                size, unit = reference.offset_deg, "deg"
                most = MOST_ZERO_OFFSET * self.tolerances.zero_offset_deg
                sd = reference.sd_deg
            else:
                axis = 0 if reference.kind == "drm_x" else 1
                size, unit = reference.value_mm - self.drm[axis], "mm"
                most = MOST_MOUNTING_SDS * self.drm_sd[axis]
                sd = reference.sd_mm
            if abs(size) > most:
                raise InputRefused(
                    f"Reference {reference.words} is {abs(size):.3g} {unit} from what the robot file expects;"
                    f" at most {most:.3g} {unit} is believed. Check the value, its sign and the robot file."
                )
            if not LEAST_REFERENCE_SD <= sd <= most:
                raise InputRefused(
                    f"Reference {reference.words} has a standard uncertainty of {sd:.3g} {unit};"
                    f" {LEAST_REFERENCE_SD:g} to {most:.3g} {unit} is believed. Check the value and its unit."
                )
        return replace(self, references=(*self.references, *references))

    def with_mechanism(self, drm: Pair, sd: Pair) -> Robot:
        """The same robot with the given MAEMM."""
        return replace(self, drm=drm, drm_sd=sd)


@lru_cache(maxsize=64)
def _grid(across: Pair, along: Pair, nx: int, ny: int) -> Complex:
    """Cached, since it is requested many times per run."""
    x, y = np.linspace(*across, nx), np.linspace(*along, ny)
    grid = np.asarray((x[:, None] + 1j * y[None, :]).ravel())
    grid.setflags(write=False)
    return grid


def read_sections(path: Path) -> Sections:
    """The tables of a robot file.  :raises InputRefused: the file is missing or is not TOML."""
    return sections_of_toml(content_of(path, "Robot file"), f"Robot file {path}")


Sign = Literal[-1, 1]


class _ToleranceSection(Section):
    e_mm: Positive = 0.03
    """Tolerance of each coordinate of the base joints."""
    link_mm: Positive = 0.03
    """Tolerance of each link length."""
    zero_offset_deg: Positive = 3.0
    """Tolerance of each zero offset."""


class _RobotSection(Section):
    serial: Annotated[str, Field(min_length=1)] = "unnamed"
    """Serial number of the robot."""
    model: Literal["five-bar"] = "five-bar"
    """Kind of machine."""
    type: Annotated[str, Field(min_length=1, max_length=64)] | None = None
    """Type designation: the geometry of earlier robots of a type is the prior of the next one; quality and
    trend can be shown by type."""
    accuracy_mm: Positive | None = None
    """Wanted accuracy of a calibration: largest position error over the workspace, mm."""
    e: tuple[tuple[Finite, Finite], tuple[Finite, Finite]] = Robot.e
    """Base joints 1 and 2, (x, y), mm."""
    L: Positive | tuple[Positive, Positive] = Robot.L
    """Lengths of the proximal links, mm; one number applies to both."""
    l: Positive | tuple[Positive, Positive] = Robot.l  # noqa: E741
    """Lengths of the distal links, mm; one number applies to both."""
    tolerance: _ToleranceSection = _ToleranceSection()


class _MechanismSection(Section):
    c: tuple[Finite, Finite] = Robot.c
    """Mounting point of the mechanism, mm."""
    d: tuple[Finite, Finite] = Robot.d
    """Vector from the mounting point to the pivot of the scale, mm."""
    drm_mm: tuple[Finite, Finite] = Robot.drm
    """Expected mounting error, mm."""
    drm_sd_mm: Positive | tuple[Positive, Positive] = Robot.drm_sd
    """Standard uncertainty of the mounting error, mm."""
    reference: tuple[MountingError, ...] = ()
    """Measured errors of the mounting; they are valid until the mechanism is remounted."""
    mounts: dict[str, tuple[Finite, Finite]] = Field(default_factory=dict)
    """Further mounting points c, mm, by the `mount` id of the measurement file."""


class _WorkspaceSection(Section):
    x: tuple[Finite, Finite] = Robot.workspace_x
    """Lower and upper limit, mm."""
    y: tuple[Finite, Finite] = Robot.workspace_y
    """Lower and upper limit, mm."""


class _JointsSection(Section):
    counts_per_rev: Annotated[int, Field(gt=0)] = Robot.counts_per_rev
    """Pulses per revolution of the motor."""
    ratio: Positive = Robot.ratio
    """Revolutions of the motor per revolution of the joint."""
    zero_at_deg: tuple[Finite, Finite] = Robot.zero_at_deg
    """Joint angles at the zeros of the drives."""
    sign: Sign | tuple[Sign, Sign] = Robot.sign  # type: ignore[assignment]
    """1 if a joint angle increases with the pulses of its drive, else -1; one number applies to both."""
    feedback_sd_deg: Annotated[float, Field(ge=0, allow_inf_nan=False)] | None = None
    """Standard uncertainty of the joint angle from the feedback; by default that of one pulse."""


class RobotFile(Section):
    """The sections of the robot file."""

    robot: _RobotSection = _RobotSection()
    mechanism: _MechanismSection = _MechanismSection()
    workspace: _WorkspaceSection = _WorkspaceSection()
    joints: _JointsSection = _JointsSection()

    def to_robot(self, source: str) -> Robot:
        """:raises InputRefused: limits of the workspace are out of order or out of reach."""
        for axis, (low, high) in (("x", self.workspace.x), ("y", self.workspace.y)):
            if low >= high:
                raise InputRefused(f"{source}: [workspace.{axis}] must be [lower, upper] with lower < upper.")
        robot = Robot(
            serial=self.robot.serial,
            type=self.robot.type,
            e=self.robot.e,
            L=_pair(self.robot.L),
            l=_pair(self.robot.l),
            c=self.mechanism.c,
            d=self.mechanism.d,
            drm=self.mechanism.drm_mm,
            drm_sd=_pair(self.mechanism.drm_sd_mm),
            mounts=self.mechanism.mounts,
            tolerances=Tolerances(**self.robot.tolerance.model_dump()),
            workspace_x=self.workspace.x,
            workspace_y=self.workspace.y,
            counts_per_rev=self.joints.counts_per_rev,
            ratio=self.joints.ratio,
            zero_at_deg=self.joints.zero_at_deg,
            sign=self.joints.sign if isinstance(self.joints.sign, tuple) else (self.joints.sign,) * 2,
            accuracy_mm=self.robot.accuracy_mm,
        )
        stated = self.joints.feedback_sd_deg
        # earlier versions stored the default as if it had been stated
        if stated is not None and not math.isclose(stated, robot.joint_sd_deg):
            robot = replace(robot, feedback_sd_deg=stated)
        try:
            robot = robot.informed(self.mechanism.reference)
        except InputRefused as error:
            raise InputRefused(f"{source}: [[mechanism.reference]] {error}") from error
        try:
            inverse(robot.geometry, robot.workspace_grid(3, 3))
        except Unreachable as error:
            raise InputRefused(
                f"{source}: the arms [robot] L, l cannot reach all of [workspace]: {error}"
            ) from error
        return robot


def _pair(value: float | Pair) -> Pair:
    return value if isinstance(value, tuple) else (value, value)
