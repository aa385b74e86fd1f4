"""Base that warms from one side (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, JointNumber, Scene


class BaseGradient(Effect):
    """A motor warms one bracket of the base, which grows up and outwards with the time constant.

    The centre of that joint moves by `out_mm` away from the other and by `up_mm`, when all is warm; the
    thermometer on the machine is on the other side and does not detect it.
    """

    kind: Literal["base_gradient"] = "base_gradient"
    joint: JointNumber = 1
    out_mm: float = 0.06
    up_mm: float = 0.02
    tau_s: float = Field(default=60.0, gt=0)

    def on_base_mm(self, joint: JointNumber, scene: Scene) -> tuple[float, float]:
        if joint != self.joint:
            return 0.0, 0.0
        warmth = -math.expm1(-scene.t_s / self.tau_s)
        outwards = 1 if joint == 1 else -1
        return outwards * self.out_mm * warmth, self.up_mm * warmth
