"""References: one cheap look from outside that is worth more than many readings.

Each measures one unknown of the model, with an uncertainty of its own.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field

from station.records.record import Record
from station.records.sections import Finite, Positive, Section
from station.records.study_design import StudyDesign


class JointAngle(Section):
    """The angle of a proximal link, seen by an instrument in the robot's frame while the drive stands."""

    kind: Literal["joint_angle"] = "joint_angle"
    joint: Literal[1, 2]
    at_deg: Finite
    """What the drive's feedback says at that moment."""
    reads_deg: Finite
    """What the instrument says."""
    sd_deg: Positive
    """Standard uncertainty of the instrument, its alignment included."""

    @property
    def unit(self) -> str:
        """Of what is measured."""
        return "deg"

    @property
    def parameter(self) -> str:
        """The unknown that is measured."""
        return f"dtheta{self.joint}"

    @property
    def offset_deg(self) -> float:
        """The zero offset as seen: actual less nominal angle, within half a turn."""
        return math.remainder(self.reads_deg - self.at_deg, 360.0)

    @property
    def words(self) -> str:
        """For people."""
        return f"joint {self.joint} at {self.at_deg:g} deg reads {self.reads_deg:g} deg"


class MountingError(Section):
    """An error of the mechanism's mounting (MAEMM), measured: of c + d, sideways or in height."""

    kind: Literal["drm_x", "drm_y"]
    """Sideways or in height."""
    value_mm: Finite
    """Actual less nominal."""
    sd_mm: Positive
    """Standard uncertainty of the measurement."""

    @property
    def unit(self) -> str:
        """Of what is measured."""
        return "mm"

    @property
    def parameter(self) -> str:
        """The unknown that is measured."""
        return {"drm_x": "rMx", "drm_y": "rMy"}[self.kind]

    @property
    def words(self) -> str:
        """For people."""
        return f"{self.kind} = {self.value_mm:g} mm"


AnyReference = Annotated[JointAngle | MountingError, Field(discriminator="kind")]


class Asked(Record):
    """What a start request says of accuracy, references and a gauge study."""

    references: tuple[AnyReference, ...] = ()
    until_mm: float | None = None
    accuracy_mm: float | None = None
    study: StudyDesign | None = None


class ReferenceUse(Record):
    """A reference that took part in a fit, and how well everything else agrees with it."""

    reference: AnyReference
    residual: float | None = None
    """Reference less what everything else says, in the unit of the parameter; null when nothing else says
    anything of it."""
    sd: float | None = None
    """Standard uncertainty of that difference."""
    unit: str
    p_value: float | None = None
    """Of a difference that large, if both are right; null where that was not judged."""
