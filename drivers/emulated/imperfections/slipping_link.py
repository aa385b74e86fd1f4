"""Distal link that slips in its clamp (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, JointNumber, Lengths, Scene


class SlippingLink(Effect):
    """The clamp of one distal link slips once: from the `from_stop`-th stop on the link is `mm` longer."""

    kind: Literal["slipping_link"] = "slipping_link"
    joint: JointNumber
    mm: float = 0.04
    from_stop: int = Field(default=60, ge=1)

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        if scene.stop >= self.from_stop:
            lengths.l[self.joint - 1] += self.mm
