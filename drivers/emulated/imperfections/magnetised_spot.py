"""Magnetised spot of the scale (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class MagnetisedSpot(Effect):
    """A magnet has touched the scale: the head reads ahead before the spot and behind after it.

    The error is the slope of a bell about `rho_mm`, with its extremes of `peak_mm` at `half_width_mm` on
    either side.
    """

    kind: Literal["magnetised_spot"] = "magnetised_spot"
    rho_mm: float = 560.0
    half_width_mm: float = Field(default=25.0, gt=0)
    peak_mm: float = 0.025

    def on_head_mm(self, scene: Scene) -> float:
        aside = (scene.rho_mm - self.rho_mm) / self.half_width_mm
        return -self.peak_mm * aside * math.exp((1 - aside**2) / 2)
