"""Parts that grow while the machine warms up."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Lengths, Scene


class ThermalGrowth(Effect):
    """The temperature rises by `rise_k` with time constant `tau_s`; links and scale grow with it.

    A grown scale reads too little, in proportion to the travel.  A coefficient of zero excludes a part.
    """

    kind: Literal["thermal_growth"] = "thermal_growth"
    rise_k: float
    tau_s: float = Field(gt=0)
    links_um_per_m_per_k: float = 0.0
    scale_um_per_m_per_k: float = 0.0

    def temperature_rise_k(self, t_s: float) -> float:
        return self.rise_k * (1 - math.exp(-t_s / self.tau_s))

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        growth = 1 + self.links_um_per_m_per_k * 1e-6 * self.temperature_rise_k(scene.t_s)
        lengths.L = [length * growth for length in lengths.L]
        lengths.l = [length * growth for length in lengths.l]

    def on_head_mm(self, scene: Scene) -> float:
        return -self.scale_um_per_m_per_k * 1e-6 * self.temperature_rise_k(scene.t_s) * scene.travel_mm
