"""Rest position that depends on the speed of approach (outside the diagnosis's catalogue)."""

from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class SpeedStiction(JointEffect):
    """An arm that arrives slowly has its grease squeezed out and sticks short of its target.

    It lags its last motion by `deg` / (1 + top speed / `frees_deg_per_s`).
    """

    stage: ClassVar[int] = 2

    kind: Literal["speed_stiction"] = "speed_stiction"
    deg: float = 0.0065
    frees_deg_per_s: float = Field(default=15.0, gt=0)

    def at_joint_deg(self, scene: Scene) -> float:
        i = self.joint - 1
        return -self.deg * scene.direction[i] / (1 + scene.top_deg_per_s[i] / self.frees_deg_per_s)
