"""Bent guide."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class ScaleBow(Effect):
    """On a bent guide the head tilts, and its distance from the measured line causes an (Abbe) error.

    The error is a parabola: nothing at mid-travel, `mm_at_end` at both ends.
    """

    kind: Literal["scale_bow"] = "scale_bow"
    mm_at_end: float
    rho_mid_mm: float = 600.0
    half_travel_mm: float = Field(default=100.0, gt=0)

    def on_head_mm(self, scene: Scene) -> float:
        return self.mm_at_end * ((scene.rho_mm - self.rho_mid_mm) / self.half_travel_mm) ** 2
