"""Clearance in the passive joint at an elbow."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, JointNumber, Lengths, Scene


class JointClearance(Effect):
    """The load pulls the pin against one side of its bore.

    The distal link carries the weight of P together with its neighbour; pulled, it acts `mm` longer, pushed
    `mm` shorter.  Equilibrium at P determines which of the two applies.
    """

    kind: Literal["joint_clearance"] = "joint_clearance"
    joint: JointNumber
    mm: float = Field(ge=0)

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        lengths.l[self.joint - 1] += math.copysign(self.mm, self._pull(scene))

    def _pull(self, scene: Scene) -> float:
        """Positive if the link is pulled; from the elbows' angles as seen from P."""
        (own_x, own_y), (other_x, other_y) = self._directions(scene)
        return other_x / (other_x * own_y - own_x * other_y)

    def _directions(self, scene: Scene) -> tuple[tuple[float, float], tuple[float, float]]:
        """Unit vectors from P along this distal link and along the other one."""
        i = self.joint - 1
        x, y = scene.r_mm
        directions = []
        for elbow_x, elbow_y in scene.elbows_mm:
            length = math.hypot(elbow_x - x, elbow_y - y)
            directions.append(((elbow_x - x) / length, (elbow_y - y) / length))
        return directions[i], directions[1 - i]
