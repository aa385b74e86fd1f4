"""Rest position that depends on the distance of approach (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class RestByDistance(JointEffect):
    """A seal drags the arm back, fully after a long motion and hardly after a short one.

    The arm lags its last motion by `deg` times (1 - exp(-way / `winds_deg`)).
    """

    stage: ClassVar[int] = 2

    kind: Literal["rest_by_distance"] = "rest_by_distance"
    deg: float = 0.0035
    winds_deg: float = Field(default=8.0, gt=0)

    def at_joint_deg(self, scene: Scene) -> float:
        i = self.joint - 1
        return self.deg * scene.direction[i] * math.expm1(-scene.way_deg[i] / self.winds_deg)
