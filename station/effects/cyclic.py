"""Errors that are periodic in the joint's angle: encoder eccentricity and gear ripple."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from station.effects.base import Acts, Bounds, JointEffect, Variants, amplitude_and_phase
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase

SAME_STOP_RAD = 1e-3
LEAST_STEP_RAD = 20.0 * SAME_STOP_RAD
"""Finer steps cannot be distinguished from arbitrary angles."""
FEWEST_STOPS, MOST_STOPS = 3, 60
"""Number of stops of a joint: fewer are not a grid, more are not set up by hand."""
OVERSAMPLING = 3.0
"""Search steps per independent frequency."""


def wave(angle: Real, per_turn: float) -> Real:
    """(K, 2) cosine and sine of a multiple of an angle (K,)."""
    return np.column_stack([np.cos(per_turn * angle), np.sin(per_turn * angle)])


def waves(angle: Real, first: float, step: float, count: int) -> Real:
    """(V, K, 2) the same for the multiples first, first + step, ...: each rotated from the previous one."""
    turning = np.empty((count, len(angle)), dtype=complex)
    turning[0] = np.exp(1j * first * angle)
    turning[1:] = np.exp(1j * step * angle)
    np.multiply.accumulate(turning, axis=0, out=turning)
    return turning.view(float).reshape(count, len(angle), 2)


def fastest_seen(angle: Real) -> float:
    """Cycles per turn that readings at angles (K,), rad, distinguish from slower ones; inf without a grid.

    On a grid of step s a wave of n cycles looks like one of 2 pi / s - n (Nyquist).
    """
    stops = np.unique(np.round(angle / SAME_STOP_RAD)) * SAME_STOP_RAD
    if not FEWEST_STOPS <= len(stops) <= MOST_STOPS:
        return np.inf
    gaps = np.diff(stops)
    step = float(gaps[gaps > 2.0 * SAME_STOP_RAD].min(initial=np.inf))
    steps = gaps / step
    on_grid = np.abs(steps - np.round(steps)) * step < 2.0 * SAME_STOP_RAD
    return float(np.pi / step) if step >= LEAST_STEP_RAD and on_grid.all() else np.inf


class EncoderEccentricity(JointEffect):
    id = "encoder_eccentricity"
    physics = phrase("encoder_eccentricity_physics")
    remedy = phrase("encoder_eccentricity_remedy")
    experiment = phrase("encoder_eccentricity_experiment")
    bounds: ClassVar[Bounds] = {"amplitude_deg": (0.0, 1.0)}

    def variants(self, c: Conditions) -> Variants | None:
        i = self.index
        return Variants(Acts(joint=i), wave(c.theta[:, i], 1.0)[None], ({"per_rev": 1.0},), 1.0)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return amplitude_and_phase("amplitude_deg", "deg", 180.0 / np.pi, amplitudes, covariance)


class GearCyclic(JointEffect):
    id = "gear_cyclic"
    physics = phrase("gear_cyclic_physics")
    remedy = phrase("gear_cyclic_remedy")
    experiment = phrase("gear_cyclic_experiment")
    bounds: ClassVar[Bounds] = {"amplitude_deg": (0.0, 0.5)}

    repeats = True
    LOWEST, HIGHEST = 4.0, 80.0

    def variants(self, c: Conditions) -> Variants | None:
        i = self.index
        span = float(np.ptp(c.theta[:, i]))
        if span <= 0.0:
            return None
        # below about one and a half periods over the visited range a ripple is a smooth curve
        lowest = max(self.LOWEST, 1.5 * 2.0 * np.pi / span)
        # on a grid of angles a faster wave is the double of a slower one, which is the simpler cause
        highest = min(self.HIGHEST, fastest_seen(c.theta[:, i]))
        if lowest >= highest:
            return None
        step = 2.0 * np.pi / span / OVERSAMPLING
        n = np.arange(lowest, highest, step)
        return Variants(
            Acts(joint=i),
            waves(c.theta[:, i], lowest, step, len(n)),
            tuple({"per_rev": float(v)} for v in n),
            (highest - lowest) * span / (2.0 * np.pi) * 2.0,
        )

    def refined(self, hidden: Mapping[str, float], c: Conditions) -> Mapping[str, tuple[float, float]]:
        step = 2.0 * np.pi / float(np.ptp(c.theta[:, self.index])) / OVERSAMPLING
        n = hidden["per_rev"]
        return {"per_rev": (n - 2 * step, n + 2 * step)}

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return wave(c.theta[:, self.index], hidden["per_rev"])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (
            *amplitude_and_phase("amplitude_deg", "deg", 180.0 / np.pi, amplitudes, covariance),
            Quantity("per_rev", hidden["per_rev"], hidden.get("per_rev_sd", 0.0), "1/rev"),
        )
