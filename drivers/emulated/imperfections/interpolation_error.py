"""Interpolation error with a harmonic (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class InterpolationError(Effect):
    """Unequal offsets and gains of the head's two signals: a sine over the period and one over its half.

    The second has `second_share` of the first's amplitude and is turned by `second_phase_deg`.
    """

    kind: Literal["interpolation_error"] = "interpolation_error"
    amplitude_mm: float = 0.013
    period_mm: float = Field(default=4.0, gt=0)
    phase_deg: float = 0.0
    second_share: float = 0.4
    second_phase_deg: float = 70.0

    def on_head_mm(self, scene: Scene) -> float:
        turn = 2 * math.pi * scene.rho_mm / self.period_mm + math.radians(self.phase_deg)
        second = self.second_share * math.sin(2 * turn + math.radians(self.second_phase_deg))
        return self.amplitude_mm * (math.sin(turn) + second)
