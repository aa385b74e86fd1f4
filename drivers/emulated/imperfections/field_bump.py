"""Magnetised or damaged point of the scale (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class FieldBump(Effect):
    """Around one point of its travel the head misreads: a bell of height `height_mm`, sd `half_width_mm`."""

    kind: Literal["field_bump"] = "field_bump"
    rho_mm: float
    half_width_mm: float = Field(gt=0)
    height_mm: float

    def on_head_mm(self, scene: Scene) -> float:
        aside = (scene.rho_mm - self.rho_mm) / self.half_width_mm
        return self.height_mm * math.exp(-(aside**2) / 2)
