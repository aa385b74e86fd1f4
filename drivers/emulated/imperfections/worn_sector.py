"""Teeth worn in a sector of the gear (outside the diagnosis's catalogue)."""

import math
from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class WornSector(JointEffect):
    """The teeth are worn where the gear was used most, and the arm sinks into the gap there.

    The wear is a cosine hump of depth `deg` at the travel `at_deg`, `sector_deg` wide from edge to edge.
    """

    stage: ClassVar[int] = 1

    kind: Literal["worn_sector"] = "worn_sector"
    deg: float = 0.008
    at_deg: float = 0.0
    sector_deg: float = Field(default=40.0, gt=0)

    def at_joint_deg(self, scene: Scene) -> float:
        aside = (scene.travel_deg[self.joint - 1] - self.at_deg) / self.sector_deg
        return -self.deg * (1 + math.cos(2 * math.pi * aside)) / 2 if abs(aside) < 0.5 else 0.0
