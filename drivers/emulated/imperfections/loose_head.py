"""Head with a slightly different position at every stop (outside the diagnosis's catalogue)."""

from random import Random
from typing import Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, Scene


class LooseHead(Effect):
    """The head is loose on its carrier and shifts at each stop, with standard deviation `sd_mm`."""

    kind: Literal["loose_head"] = "loose_head"
    sd_mm: float = Field(default=0.01, ge=0)
    _rng: Random = PrivateAttr()
    _shift_mm: float = PrivateAttr(default=0.0)

    def start(self, rng: Random) -> None:
        self._rng = rng

    def on_stop(self) -> None:
        self._shift_mm = self._rng.gauss(0.0, self.sd_mm)

    def on_head_mm(self, scene: Scene) -> float:
        return self._shift_mm
