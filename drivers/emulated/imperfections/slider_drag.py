"""Drag of the head's cable on the slider (outside the diagnosis's catalogue)."""

from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, Play, Scene


class SliderDrag(Effect):
    """The head's cable tightens as the slider moves out, and tilts the head against its motion.

    The head lags by zero where the scale is at `slack_mm`, and by `width_mm` a hundred millimetres further
    out.
    """

    follows_path: ClassVar[bool] = True

    kind: Literal["slider_drag"] = "slider_drag"
    width_mm: float = Field(ge=0)
    slack_mm: float = 500.0
    _play: Play = PrivateAttr(default_factory=Play)

    def on_head_mm(self, scene: Scene) -> float:
        tightness = max(scene.rho_mm - self.slack_mm, 0.0) / 100.0
        return self._play.follow(scene.rho_mm, self.width_mm * tightness)
