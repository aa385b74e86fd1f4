"""Joint whose bracket the other arm twists (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from drivers.emulated.imperfections.base import JointEffect, JointNumber, Scene


class ArmCoupling(JointEffect):
    """Both drives sit in one bracket, and the weight of the other joint's arm twists it.

    This joint's arm turns by `deg_at_horizontal` while the other arm lies flat, and by the cosine of its
    angle otherwise.
    """

    kind: Literal["arm_coupling"] = "arm_coupling"
    joint: JointNumber
    deg_at_horizontal: float = 0.016

    def at_joint_deg(self, scene: Scene) -> float:
        other = math.radians(scene.theta_deg[2 - self.joint])
        return self.deg_at_horizontal * math.cos(other)
