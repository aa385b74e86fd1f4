"""Readout that jumps and returns (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class HealingStep(Effect):
    """A chip under the slider adds `step_mm` from the `from_stop`-th stop on, for `for_stops` stops."""

    kind: Literal["healing_step"] = "healing_step"
    step_mm: float = 0.02
    from_stop: int = Field(default=40, ge=1)
    for_stops: int = Field(default=40, ge=1)

    def on_head_mm(self, scene: Scene) -> float:
        return self.step_mm if 0 <= scene.stop - self.from_stop < self.for_stops else 0.0
