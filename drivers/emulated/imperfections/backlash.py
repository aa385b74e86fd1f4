"""Backlash between gear output and arm."""

from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from drivers.emulated.imperfections.base import JointEffect, Play, Scene


class Backlash(JointEffect):
    """The gear output turns `width_deg` before its other flank touches; friction holds the arm meanwhile.

    After a motion in the positive direction the arm therefore lags by half the width, after one in
    the negative direction it leads by half the width.
    """

    stage: ClassVar[int] = 2

    kind: Literal["backlash"] = "backlash"
    width_deg: float = Field(ge=0)
    _play: Play = PrivateAttr(default_factory=Play)

    def at_joint_deg(self, scene: Scene) -> float:
        return self._play.follow(self.arm_deg(scene), self.width_deg)
