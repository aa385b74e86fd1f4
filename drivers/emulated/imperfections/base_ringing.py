"""Base that still oscillates when it is read (outside the diagnosis's catalogue)."""

import math
from typing import Literal

from pydantic import Field

from drivers.emulated.imperfections.base import Effect, Scene


class BaseRinging(Effect):
    """A stop makes the machine oscillate on its soft feet, and the head detects the end of it.

    From standstill on, the reading oscillates with `frequency_hz` and decays with `tau_s`; its initial
    amplitude is `mm_at_100_deg_per_s` times the sum of the joints' signed top speeds over 100 deg/s.
    """

    kind: Literal["base_ringing"] = "base_ringing"
    mm_at_100_deg_per_s: float = 0.09
    frequency_hz: float = Field(default=5.0, gt=0)
    tau_s: float = Field(default=0.15, gt=0)

    def on_head_mm(self, scene: Scene) -> float:
        pairs = zip(scene.direction, scene.top_deg_per_s, strict=True)
        push = sum(direction * speed for direction, speed in pairs) / 100.0
        swing = math.cos(2 * math.pi * self.frequency_hz * scene.rested_s)
        return self.mm_at_100_deg_per_s * push * swing * math.exp(-scene.rested_s / self.tau_s)
