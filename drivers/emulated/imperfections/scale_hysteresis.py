"""Head that tilts with the direction of travel."""

from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, Play, Scene


class ScaleHysteresis(Effect):
    """The slider's friction tilts the head; it lags by `width_mm`, so the reading lags the travel."""

    follows_path: ClassVar[bool] = True

    kind: Literal["scale_hysteresis"] = "scale_hysteresis"
    width_mm: float = Field(ge=0)
    _play: Play = PrivateAttr(default_factory=Play)

    def on_head_mm(self, scene: Scene) -> float:
        return self._play.follow(scene.rho_mm, self.width_mm)
