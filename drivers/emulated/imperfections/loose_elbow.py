"""Loose passive joint moved by friction (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, JointNumber, Lengths, Scene


class LooseElbow(Effect):
    """The elbow's pin is pushed ahead by the arm: it is at one side of its bore or the other.

    After a motion that lifts the elbow (joint 1 positive, joint 2 negative) the distal link acts `mm` longer,
    after the other one `mm` shorter.
    """

    kind: Literal["loose_elbow"] = "loose_elbow"
    joint: JointNumber
    mm: float = Field(default=0.017, ge=0)

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        i = self.joint - 1
        lengths.l[i] += self.mm * scene.direction[i] * (1 if self.joint == 1 else -1)
