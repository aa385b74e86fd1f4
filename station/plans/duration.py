"""The duration of a station's motions from stop to stop: both joints together, run-ups included."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.mechanism import last_senses, needs_run_up
from station.records import Index, Real
from station.settings import LimitSettings

Sides = Real | Index
"""Signs of last motions, 0 where they do not matter."""
ARRIVAL_S = 0.05
"""Time from the end of a motion until both drives have reported it."""
SAMPLE_S = 0.03
"""One sample of the readout with the feedback of both drives, on their lines."""


@dataclass(frozen=True)
class Pace:
    """The speed of one station."""

    speed_deg_s: float
    run_up_deg: float
    reading_s: float
    """Time from standstill until the samples agree."""
    samples: int = 1
    """Number of samples of a reading."""

    @classmethod
    def of(cls, limits: LimitSettings) -> Pace:
        """The pace defined by a station file."""
        return cls(limits.speed_deg_s, limits.overshoot_deg, limits.samples * SAMPLE_S, limits.samples)

    def travel_deg(self, here: Real, there: Real, approach: Sides) -> Real:
        """(...,) motion of the joint with the longest one, the run-up of a requested approach included.

        here, there, approach (..., 2): deg, and signs of the last motion, 0 where it does not matter.
        """
        return self._leg(here, there, approach)[0]

    def duration_s(self, here: Real, there: Real, approach: Sides) -> Real:
        """(...,) duration of the motion and the reading at its end."""
        return self._leg(here, there, approach)[1]

    def _leg(self, here: Real, there: Real, approach: Sides) -> tuple[Real, Real]:
        """(...,) travel and duration."""
        way = there - here
        senses = last_senses(approach, way)
        run_up = needs_run_up(senses, way, self.run_up_deg)
        direct = np.abs(way).max(axis=-1)
        detour = np.abs(way - senses * self.run_up_deg).max(axis=-1) + self.run_up_deg
        travel_deg = np.where(run_up, detour, direct)
        return travel_deg, travel_deg / self.speed_deg_s + (1 + run_up) * ARRIVAL_S + self.reading_s

    def along(self, theta_deg: Real, approach: Sides, start_deg: Real | None = None) -> tuple[Real, Real]:
        """(R,) travel and duration of each leg of a sequence theta_deg (R, 2); the first from `start_deg`.

        Without a start the first leg has zero length.
        """
        here = np.vstack([theta_deg[:1] if start_deg is None else start_deg, theta_deg[:-1]])
        return self._leg(here, theta_deg, approach)


USUAL = Pace.of(LimitSettings())
"""Pace of a station whose file does not define it."""
