"""Single readings that are wrong."""

from random import Random
from typing import Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, Scene


class Outliers(Effect):
    """Contamination on the grating: with probability `rate` a stop reads `size_mm` too much or too little."""

    kind: Literal["outliers"] = "outliers"
    rate: float = Field(ge=0, le=1)
    size_mm: float
    _rng: Random = PrivateAttr()
    _present_mm: float = PrivateAttr(default=0.0)

    def start(self, rng: Random) -> None:
        self._rng = rng

    def on_stop(self) -> None:
        hit = self._rng.random() < self.rate
        self._present_mm = self._rng.choice((-1, 1)) * self.size_mm if hit else 0.0

    def on_head_mm(self, scene: Scene) -> float:
        return self._present_mm
