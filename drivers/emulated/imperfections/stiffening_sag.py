"""Sag of both arms that stiffens with load (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, JointNumber, Scene


class StiffeningSag(Effect):
    """Both gears wind up under their arms' weight, with increasing stiffness as more teeth engage.

    At a share cos(theta) of the full load the sag is `deg_at_horizontal` times (1 + k) cos / (1 + k |cos|)
    with k = `stiffening`; k = 0 is a linear spring.
    """

    stage: ClassVar[int] = 3

    kind: Literal["stiffening_sag"] = "stiffening_sag"
    deg_at_horizontal: float = 0.03
    stiffening: float = Field(default=3.0, ge=0)

    def on_joint_deg(self, joint: JointNumber, scene: Scene) -> float:
        load = math.cos(math.radians(scene.theta_deg[joint - 1]))
        share = (1 + self.stiffening) * load / (1 + self.stiffening * abs(load))
        return -self.deg_at_horizontal * share
