"""Eccentric code disc of an encoder on the joint."""

import math
from typing import ClassVar, Literal

from drivers.emulated.imperfections.base import JointEffect, Scene


class EncoderEccentricity(JointEffect):
    """The disc's centre is offset from the axis, so its angle error is a sine once per turn.

    The servo loop brings the *encoder* to its target; the error is the arm's deviation from it.
    """

    stage: ClassVar[int] = 0

    kind: Literal["encoder_eccentricity"] = "encoder_eccentricity"
    amplitude_deg: float
    phase_deg: float = 0.0

    def at_joint_deg(self, scene: Scene) -> float:
        return self.amplitude_deg * math.sin(math.radians(self.arm_deg(scene) + self.phase_deg))
