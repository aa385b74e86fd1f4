"""Reading with a random walk (outside the diagnosis's catalogue)."""

from random import Random
from typing import Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, Scene


class RandomWalk(Effect):
    """A loose head mount that settles again after every motion: each stop shifts it by `mm_per_stop` (sd)."""

    kind: Literal["random_walk"] = "random_walk"
    mm_per_stop: float = Field(ge=0)
    _rng: Random = PrivateAttr()
    _shift_mm: float = PrivateAttr(default=0.0)

    def start(self, rng: Random) -> None:
        self._rng = rng

    def on_stop(self) -> None:
        self._shift_mm += self._rng.gauss(0.0, self.mm_per_stop)

    def on_head_mm(self, scene: Scene) -> float:
        return self._shift_mm
