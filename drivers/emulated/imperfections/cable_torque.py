"""Torque of a cable loom that stiffens (outside the diagnosis's catalogue)."""

from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class CableTorque(JointEffect):
    """A loom round the joint is a spring that stiffens: its torque grows with the cube of the travel.

    It turns the compliant arm back by `deg_at_end` where the joint has turned `reach_deg`, whatever the
    direction of motion.
    """

    stage: ClassVar[int] = 3

    kind: Literal["cable_torque"] = "cable_torque"
    deg_at_end: float = 0.012
    reach_deg: float = Field(default=45.0, gt=0)

    def at_joint_deg(self, scene: Scene) -> float:
        return -self.deg_at_end * (scene.travel_deg[self.joint - 1] / self.reach_deg) ** 3
