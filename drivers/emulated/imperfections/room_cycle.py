"""Room whose air conditioning cycles (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class RoomCycle(Effect):
    """The thin carrier of the head expands with the room's air: a sine in time, unseen by any thermometer."""

    kind: Literal["room_cycle"] = "room_cycle"
    amplitude_mm: float = 0.014
    period_s: float = Field(default=50.0, gt=0)
    phase_deg: float = 0.0

    def on_head_mm(self, scene: Scene) -> float:
        turn = 2 * math.pi * scene.t_s / self.period_s + math.radians(self.phase_deg)
        return self.amplitude_mm * math.sin(turn)
