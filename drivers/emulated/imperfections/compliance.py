"""Torsional compliance between motor and arm."""

import math
from typing import ClassVar, Literal

from drivers.emulated.imperfections.base import JointEffect, Scene


class Compliance(JointEffect):
    """The drive train winds up under the weight of arm and elbow, whose lever arm is cos(theta).

    `deg_at_horizontal` is the sag of a horizontal arm; a hanging or upright arm does not sag.
    """

    stage: ClassVar[int] = 3

    kind: Literal["compliance"] = "compliance"
    deg_at_horizontal: float

    def at_joint_deg(self, scene: Scene) -> float:
        return -self.deg_at_horizontal * math.cos(math.radians(self.arm_deg(scene)))
