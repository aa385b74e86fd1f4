"""Platform turned by a distal link (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from drivers.emulated.imperfections.base import Effect, JointNumber, Scene, turned

_AT_HOME_DEG = {1: 56.528, 2: 123.472}
"""Direction from P to the elbow, arms at 0 and 180 deg: cosine 455 / 825."""


class PlatformYaw(Effect):
    """A tight joint at P couples the platform to one distal link: it turns by `share` of that link's turn.

    The link's turn is relative to its direction with the arms at their zeros; O_2 is at (0, -`arm_mm`) from
    P.
    """

    kind: Literal["platform_yaw"] = "platform_yaw"
    joint: JointNumber = 1
    share: float = 0.006
    arm_mm: float = 51.0

    def on_mechanism_mm(self, scene: Scene) -> tuple[float, float]:
        elbow_x, elbow_y = scene.elbows_mm[self.joint - 1]
        x, y = scene.r_mm
        points_deg = math.degrees(math.atan2(elbow_y - y, elbow_x - x))
        return turned((0.0, -self.arm_mm), self.share * (points_deg - _AT_HOME_DEG[self.joint]))
