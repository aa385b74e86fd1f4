"""Cyclic transmission error of a gear."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class GearCyclic(JointEffect):
    """A wheel with runout makes its ratio vary, `per_rev` times per turn of the joint."""

    stage: ClassVar[int] = 1

    kind: Literal["gear_cyclic"] = "gear_cyclic"
    amplitude_deg: float
    per_rev: float = Field(gt=0)
    phase_deg: float = 0.0

    def at_joint_deg(self, scene: Scene) -> float:
        turned_deg = self.per_rev * scene.travel_deg[self.joint - 1] + self.phase_deg
        return self.amplitude_deg * math.sin(math.radians(turned_deg))
