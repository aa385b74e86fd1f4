"""Guide rod that sags (outside the diagnosis's catalogue)."""

from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class GuideSag(Effect):
    """The guide rod sags more the further it is extended and the more it is inclined.

    The head's reading error is proportional to the square of the travel times the position: `mm_at_corner`
    where the rod is extended `draw_mm` beyond `short_mm` and P is at x = `reach_mm`.
    """

    kind: Literal["guide_sag"] = "guide_sag"
    mm_at_corner: float = 0.02
    short_mm: float = 500.0
    draw_mm: float = Field(default=200.0, gt=0)
    reach_mm: float = Field(default=240.0, gt=0)

    def on_head_mm(self, scene: Scene) -> float:
        drawn = (scene.rho_mm - self.short_mm) / self.draw_mm
        return self.mm_at_corner * drawn**2 * scene.r_mm[0] / self.reach_mm
