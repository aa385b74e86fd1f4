"""Belt whose tension varies with the joint's angle (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class BeltStretch(JointEffect):
    """A belt drive deflects under the arm's weight, more with a slacker belt.

    The slackness changes with the cube of the travel: the sag of a horizontal arm is `deg_at_horizontal` at
    the drive's zero and (1 + `change`) times that where the joint has turned `reach_deg`.
    """

    stage: ClassVar[int] = 3

    kind: Literal["belt_stretch"] = "belt_stretch"
    deg_at_horizontal: float = 0.015
    change: float = 1.0
    reach_deg: float = Field(default=45.0, gt=0)

    def at_joint_deg(self, scene: Scene) -> float:
        slackness = 1 + self.change * (scene.travel_deg[self.joint - 1] / self.reach_deg) ** 3
        return -self.deg_at_horizontal * slackness * math.cos(math.radians(self.arm_deg(scene)))
