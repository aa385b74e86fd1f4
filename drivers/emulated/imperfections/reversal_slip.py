"""Coupling that slips when the motion reverses (outside the diagnosis's catalogue)."""

from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import JointEffect, LastStop, Scene


class ReversalSlip(JointEffect):
    """A loose clamp slips at each reversal: forwards by `deg_up` where the motion becomes positive, back by
    `deg_down` where it becomes negative. If the two differ, the zero creeps.
    """

    stage: ClassVar[int] = 0

    kind: Literal["reversal_slip"] = "reversal_slip"
    deg_up: float = Field(default=0.003, ge=0)
    deg_down: float = Field(default=0.0028, ge=0)
    _last: LastStop = PrivateAttr(default_factory=LastStop)
    _counted: int = PrivateAttr(default=-1)
    _slipped_deg: float = PrivateAttr(default=0.0)

    def at_joint_deg(self, scene: Scene) -> float:
        direction = scene.direction[self.joint - 1]
        before = self._last.before(scene.stop, direction)
        if scene.stop != self._counted:
            self._counted = scene.stop
            if before and direction == -before:
                self._slipped_deg += self.deg_up if direction > 0 else -self.deg_down
        return self._slipped_deg
