"""Scale whose division is too coarse or too fine."""

from typing import Literal

from drivers.emulated.imperfections.base import Effect, Scene


class ScaleGain(Effect):
    """Each metre of travel reads `ppm` micrometres too much."""

    kind: Literal["scale_gain"] = "scale_gain"
    ppm: float

    def on_head_mm(self, scene: Scene) -> float:
        return self.ppm * 1e-6 * scene.travel_mm
