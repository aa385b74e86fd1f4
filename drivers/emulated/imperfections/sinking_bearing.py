"""Joint centre that sinks (outside the diagnosis's catalogue)."""

from typing import Literal

from drivers.emulated.imperfections.base import Effect, JointNumber, Scene


class SinkingBearing(Effect):
    """The wedge under one bracket slips: its joint's centre sinks by `mm_per_min`."""

    kind: Literal["sinking_bearing"] = "sinking_bearing"
    joint: JointNumber
    mm_per_min: float = 0.07

    def on_base_mm(self, joint: JointNumber, scene: Scene) -> tuple[float, float]:
        return (0.0, -self.mm_per_min * scene.t_s / 60.0) if joint == self.joint else (0.0, 0.0)
