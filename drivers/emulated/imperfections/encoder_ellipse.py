"""Encoder with an error twice per turn (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from drivers.emulated.imperfections.base import JointEffect, Scene


class EncoderEllipse(JointEffect):
    """A code disc clamped to an oval: its error is a sine `waves` times per turn of the joint."""

    stage: ClassVar[int] = 0

    kind: Literal["encoder_ellipse"] = "encoder_ellipse"
    amplitude_deg: float = 0.004
    waves: int = 2
    phase_deg: float = 0.0

    def at_joint_deg(self, scene: Scene) -> float:
        return self.amplitude_deg * math.sin(math.radians(self.waves * self.arm_deg(scene) + self.phase_deg))
