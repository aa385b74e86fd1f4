"""Joint axis that is not square to the plane (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Lengths, Scene


class AxisTilt(JointEffect):
    """An arm that turns about a tilted axis leaves the plane; its projection is shorter and rotated.

    The axis leans by `tilt_deg` towards `towards_deg`: of the arm's two components the one in that direction
    is shortened by cos(tilt), the one across stays.
    """

    stage: ClassVar[int] = 3

    kind: Literal["axis_tilt"] = "axis_tilt"
    tilt_deg: float = Field(default=1.3, gt=-90, lt=90)
    towards_deg: float = 45.0

    def at_joint_deg(self, scene: Scene) -> float:
        arm = math.radians(self.arm_deg(scene) - self.towards_deg)
        shadow = math.atan2(math.sin(arm), math.cos(arm) * math.cos(math.radians(self.tilt_deg)))
        return math.degrees(math.remainder(shadow - arm, 2 * math.pi))

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        shadow = math.radians(self.arm_deg(scene) - self.towards_deg)
        along = math.cos(shadow) / math.cos(math.radians(self.tilt_deg))
        lengths.L[self.joint - 1] /= math.hypot(along, math.sin(shadow))
