"""Interpolation error of the head."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class ScaleCyclic(Effect):
    """Unequal or not quite square head signals: a sine over the grating period or a multiple of it."""

    kind: Literal["scale_cyclic"] = "scale_cyclic"
    amplitude_mm: float
    period_mm: float = Field(gt=0)
    phase_deg: float = 0.0

    def on_head_mm(self, scene: Scene) -> float:
        turn = 2 * math.pi * scene.rho_mm / self.period_mm + math.radians(self.phase_deg)
        return self.amplitude_mm * math.sin(turn)
