"""Cable that winds up round a joint (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class CableWindup(JointEffect):
    """A cable coiled round the joint tightens as the joint winds it up, and slackens the other way.

    Its pull grows exponentially with the turn, e-fold in `tightens_deg`, and holds the compliant arm back
    by `deg_at_end` where the joint has turned `reach_deg` in the direction `winds`.
    """

    stage: ClassVar[int] = 3

    kind: Literal["cable_windup"] = "cable_windup"
    deg_at_end: float = 0.02
    reach_deg: float = Field(default=45.0, gt=0)
    tightens_deg: float = Field(default=20.0, gt=0)
    winds: Literal[-1, 1] = 1

    def at_joint_deg(self, scene: Scene) -> float:
        wound = math.expm1(self.winds * scene.travel_deg[self.joint - 1] / self.tightens_deg)
        return -self.winds * self.deg_at_end * wound / math.expm1(self.reach_deg / self.tightens_deg)
