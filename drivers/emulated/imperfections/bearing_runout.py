"""Joint centre with runout (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from drivers.emulated.imperfections.base import Effect, JointNumber, Scene


class BearingRunout(Effect):
    """An oval race moves the joint's centre on a small circle, `waves` times per turn of the arm."""

    kind: Literal["bearing_runout"] = "bearing_runout"
    joint: JointNumber
    amplitude_mm: float = 0.04
    waves: int = 2
    phase_deg: float = 0.0

    def on_base_mm(self, joint: JointNumber, scene: Scene) -> tuple[float, float]:
        if joint != self.joint:
            return 0.0, 0.0
        turn = math.radians(self.waves * scene.theta_deg[joint - 1] + self.phase_deg)
        return self.amplitude_mm * math.cos(turn), self.amplitude_mm * math.sin(turn)
