"""Sticky or dented section of the guide (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class StictionPatch(Effect):
    """Around one point of the workspace the slider lags: a bell of depth `depth_mm`, sd `radius_mm`."""

    kind: Literal["stiction_patch"] = "stiction_patch"
    x_mm: float
    y_mm: float
    radius_mm: float = Field(gt=0)
    depth_mm: float

    def on_head_mm(self, scene: Scene) -> float:
        x, y = scene.r_mm
        distance_mm = math.hypot(x - self.x_mm, y - self.y_mm)
        return -self.depth_mm * math.exp(-((distance_mm / self.radius_mm) ** 2) / 2)
