"""References: single external measurements, each worth more than many readings.

Each measures one unknown of the model, with its own uncertainty.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field

from station.records.record import Record
from station.records.sections import Finite, Positive, Section
from station.records.study_design import StudyDesign


class JointAngle(Section):
    """The angle of a proximal link, measured in the robot's frame at standstill of the drive."""

    kind: Literal["joint_angle"] = "joint_angle"
    joint: Literal[1, 2]
    at_deg: Finite
    """Feedback of the drive at that moment."""
    reads_deg: Finite
    """Reading of the instrument."""
    sd_deg: Positive
    """Standard uncertainty of the instrument, its alignment included."""

    @property
    def unit(self) -> str:
        """Unit of the measured quantity."""
        return "deg"

    @property
    def parameter(self) -> str:
        """The measured unknown."""
        return f"dtheta{self.joint}"

    @property
    def offset_deg(self) -> float:
        """The measured zero offset: actual less nominal angle, within half a turn."""
        return math.remainder(self.reads_deg - self.at_deg, 360.0)

    @property
    def words(self) -> str:
        """The reference in words."""
        return f"joint {self.joint} at {self.at_deg:g} deg reads {self.reads_deg:g} deg"


class MountingError(Section):
    """A measured error of the mechanism's mounting (MAEMM): of c + d, sideways or in height."""

    kind: Literal["drm_x", "drm_y"]
    """Sideways or in height."""
    value_mm: Finite
    """Actual less nominal."""
    sd_mm: Positive
    """Standard uncertainty of the measurement."""

    @property
    def unit(self) -> str:
        """Unit of the measured quantity."""
        return "mm"

    @property
    def parameter(self) -> str:
        """The measured unknown."""
        return {"drm_x": "rMx", "drm_y": "rMy"}[self.kind]

    @property
    def words(self) -> str:
        """The reference in words."""
        return f"{self.kind} = {self.value_mm:g} mm"


AnyReference = Annotated[JointAngle | MountingError, Field(discriminator="kind")]


class Asked(Record):
    """Accuracy, references and gauge study of a start request."""

    references: tuple[AnyReference, ...] = ()
    until_mm: float | None = None
    accuracy_mm: float | None = None
    study: StudyDesign | None = None


class ReferenceUse(Record):
    """A reference that was used in a fit, and how well all other data agree with it."""

    reference: AnyReference
    residual: float | None = None
    """Reference less the value from all other data, in the unit of the parameter; null if the other data do
    not determine it.
    """
    sd: float | None = None
    """Standard uncertainty of that difference."""
    unit: str
    p_value: float | None = None
    """p-value of that difference, if both are correct; null if it was not tested."""
