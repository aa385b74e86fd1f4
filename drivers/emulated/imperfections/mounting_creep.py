"""Mounting that creeps with the logarithm of time (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class MountingCreep(Effect):
    """A fresh glue joint of the head relaxes: `mm_per_decade` for each tenfold time after `from_s`."""

    kind: Literal["mounting_creep"] = "mounting_creep"
    mm_per_decade: float = 0.033
    from_s: float = Field(default=5.0, gt=0)

    def on_head_mm(self, scene: Scene) -> float:
        return self.mm_per_decade * math.log10(1 + scene.t_s / self.from_s)
