"""Platform that tilts (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene, turned


class PlatformTilt(Effect):
    """The platform turns about P as it moves sideways, and moves the mechanism's joint O_2.

    O_2 is at (0, -`arm_mm`) from P; the turn is `deg_at_reach` at x = `reach_mm`, in proportion before.
    """

    kind: Literal["platform_tilt"] = "platform_tilt"
    deg_at_reach: float = 0.16
    arm_mm: float = 51.0
    reach_mm: float = Field(default=240.0, gt=0)

    def on_mechanism_mm(self, scene: Scene) -> tuple[float, float]:
        return turned((0.0, -self.arm_mm), self.deg_at_reach * scene.r_mm[0] / self.reach_mm)
