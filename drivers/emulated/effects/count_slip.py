"""Lost encoder counts or a slipping coupling."""

from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.effects.base import JointEffect, Scene


class CountSlip(JointEffect):
    """After a given number of stops the arm stands `step_deg` further than the drive believes, for good."""

    stage: ClassVar[int] = 0

    kind: Literal["count_slip"] = "count_slip"
    step_deg: float
    from_stop: int = Field(ge=0)

    def at_joint_deg(self, scene: Scene) -> float:
        return self.step_deg if scene.stop >= self.from_stop else 0.0
