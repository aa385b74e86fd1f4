"""Lost encoder counts or a slipping coupling."""

from typing import ClassVar, Literal

from pydantic import Field

from drivers.emulated.imperfections.base import JointEffect, Scene


class CountSlip(JointEffect):
    """From its `from_stop`-th stop on, the arm deviates by `step_deg` from the drive's count."""

    stage: ClassVar[int] = 0

    kind: Literal["count_slip"] = "count_slip"
    step_deg: float
    from_stop: int = Field(ge=1)

    def at_joint_deg(self, scene: Scene) -> float:
        return self.step_deg if scene.stop >= self.from_stop else 0.0
