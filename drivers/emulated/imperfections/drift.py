"""Reading that creeps."""

from typing import Literal

from drivers.emulated.imperfections.base import Effect, Scene


class Drift(Effect):
    """A mounting that relaxes: the reading creeps in proportion to time, independent of the motion."""

    kind: Literal["drift"] = "drift"
    mm_per_hour: float

    def on_head_mm(self, scene: Scene) -> float:
        return self.mm_per_hour * scene.t_s / 3600
