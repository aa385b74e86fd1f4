"""Sticky section of the guide (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import Effect, Play, Scene


class StickyPatch(Effect):
    """Dry grease around one point: the head lags by up to `width_mm`, a bell of sd `radius_mm`."""

    follows_path: ClassVar[bool] = True

    kind: Literal["sticky_patch"] = "sticky_patch"
    x_mm: float
    y_mm: float
    radius_mm: float = Field(gt=0)
    width_mm: float = Field(ge=0)
    _play: Play = PrivateAttr(default_factory=Play)

    def on_head_mm(self, scene: Scene) -> float:
        x, y = scene.r_mm
        distance_mm = math.hypot(x - self.x_mm, y - self.y_mm)
        stickiness = math.exp(-((distance_mm / self.radius_mm) ** 2) / 2)
        return self._play.follow(scene.rho_mm, self.width_mm * stickiness)
