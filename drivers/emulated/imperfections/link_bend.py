"""Distal links that bend under their own weight (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from drivers.emulated.imperfections.base import Effect, Lengths, Scene


class LinkBend(Effect):
    """A distal link sags between its ends, and its chord is shorter than the link.

    The shortening is `mm_at_horizontal` for a horizontal link; the sag is proportional to the cosine of its
    slope, the shortening to the square of that.
    """

    kind: Literal["link_bend"] = "link_bend"
    mm_at_horizontal: float = 0.3

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        for i, (x, y) in enumerate(scene.elbows_mm):
            lengths.l[i] -= self.mm_at_horizontal * self._flatness(x - scene.r_mm[0], y - scene.r_mm[1])

    @staticmethod
    def _flatness(x_mm: float, y_mm: float) -> float:
        """Square of the cosine of the slope."""
        return (x_mm / math.hypot(x_mm, y_mm)) ** 2
