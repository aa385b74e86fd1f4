"""A link that is longer or shorter than its drawing."""

from typing import Literal

from drivers.emulated.imperfections.base import Effect, JointNumber, Lengths, Scene


class LinkLength(Effect):
    """Link L (proximal) or l (distal) of one chain is `mm` longer, beyond its tolerance."""

    kind: Literal["link_length"] = "link_length"
    joint: JointNumber
    link: Literal["L", "l"]
    mm: float

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        links = lengths.L if self.link == "L" else lengths.l
        links[self.joint - 1] += self.mm
