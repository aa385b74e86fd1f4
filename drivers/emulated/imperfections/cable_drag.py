"""Drag of a cable loom (outside the diagnosis's catalogue)."""

from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class CableDrag(JointEffect):
    """A loom that is stretched at one end of the joint's range holds the arm back, against its motion.

    The arm lags by `deg_at_end` where the joint has turned `reach_deg` from the drive's zero, in proportion
    before, with opposite sign beyond zero.
    """

    stage: ClassVar[int] = 3

    kind: Literal["cable_drag"] = "cable_drag"
    deg_at_end: float
    reach_deg: float = Field(default=45.0, gt=0)

    def at_joint_deg(self, scene: Scene) -> float:
        i = self.joint - 1
        return -self.deg_at_end * scene.direction[i] * scene.travel_deg[i] / self.reach_deg
