"""Transmission ratio that differs from its nominal value."""

from typing import ClassVar, Literal

from drivers.emulated.imperfections.base import JointEffect, Scene


class TransmissionGain(JointEffect):
    """A friction or belt stage turns the joint `ppm` millionths further than the drive's count."""

    stage: ClassVar[int] = 1

    kind: Literal["transmission_gain"] = "transmission_gain"
    ppm: float

    def at_joint_deg(self, scene: Scene) -> float:
        return self.ppm * 1e-6 * scene.travel_deg[self.joint - 1]
