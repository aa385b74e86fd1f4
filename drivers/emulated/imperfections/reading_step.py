"""Readout with a jump (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class ReadingStep(Effect):
    """An impact moves the head on its carrier: from the `from_stop`-th stop on it reads `step_mm` more."""

    kind: Literal["reading_step"] = "reading_step"
    step_mm: float = 0.02
    from_stop: int = Field(default=60, ge=1)

    def on_head_mm(self, scene: Scene) -> float:
        return self.step_mm if scene.stop >= self.from_stop else 0.0
