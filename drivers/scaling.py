"""Conversion between the pulses of a drive and a joint angle."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class JointScaling:
    """Conversion of a drive's pulses to a joint angle: theta = zero_at_deg + sign * pulses / per_deg."""

    counts_per_rev: int
    ratio: float
    zero_at_deg: float
    sign: int

    @property
    def pulses_per_deg(self) -> float:
        return self.counts_per_rev * self.ratio / 360.0

    def to_pulses(self, theta_deg: float) -> int:
        return round(self.sign * (theta_deg - self.zero_at_deg) * self.pulses_per_deg)

    def to_deg(self, pulses: int) -> float:
        return self.zero_at_deg + self.sign * pulses / self.pulses_per_deg
