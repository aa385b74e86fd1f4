"""Base frame that bends under the platform (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, JointNumber, Scene, turned

_CENTRES_MM = {1: (80.0, 0.0), 2: (-80.0, 0.0)}


class BaseFlex(Effect):
    """The post that carries both joints bends by the platform's moment, which is proportional to x.

    Both joint centres move sideways by `sideways_mm` and turn about the base by `roll_deg` where P is at x =
    `reach_mm`, the other way on the other side; the foot of the mechanism is separate.
    """

    kind: Literal["base_flex"] = "base_flex"
    sideways_mm: float = 0.15
    roll_deg: float = 0.0
    reach_mm: float = Field(default=240.0, gt=0)

    def on_base_mm(self, joint: JointNumber, scene: Scene) -> tuple[float, float]:
        share = scene.r_mm[0] / self.reach_mm
        x, y = turned(_CENTRES_MM[joint], self.roll_deg * share)
        return x + self.sideways_mm * share, y
