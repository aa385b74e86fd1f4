"""Joint zero with a random walk (outside the diagnosis's catalogue)."""

from random import Random
from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import JointEffect, Scene


class WanderingZero(JointEffect):
    """A clamp that creeps with every motion: each stop shifts the arm by `deg_per_stop` (sd), undetected."""

    stage: ClassVar[int] = 0

    kind: Literal["wandering_zero"] = "wandering_zero"
    deg_per_stop: float = Field(ge=0)
    _rng: Random = PrivateAttr()
    _shift_deg: float = PrivateAttr(default=0.0)

    def start(self, rng: Random) -> None:
        self._rng = rng

    def on_stop(self) -> None:
        self._shift_deg += self._rng.gauss(0.0, self.deg_per_stop)

    def at_joint_deg(self, scene: Scene) -> float:
        return self._shift_deg
