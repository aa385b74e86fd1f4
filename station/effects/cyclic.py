"""Errors that repeat with the joint's turning: encoder eccentricity and gear ripple."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.effects.base import Acts, Conditions, Effect, Variants, amplitude_and_phase
from station.kinematics import Real
from station.records import Quantity

OVERSAMPLING = 3.0
"""Search steps per independent frequency."""


def wave(angle: Real, per_turn: Real) -> Real:
    """(V, K, 2) sine and cosine of V multiples of an angle (K,)."""
    phase = np.asarray(per_turn)[:, None] * angle
    return np.stack([np.sin(phase), np.cos(phase)], axis=-1)


class EncoderEccentricity(Effect):
    id = "encoder_eccentricity"
    physics = "An encoder disc off its centre errs once a turn of the joint."
    remedy = "Re-centre or replace the encoder, or keep the term in the controller's model."
    experiment = "Read over a wider range of the joint, or from a second mount of the mechanism."

    def variants(self, c: Conditions) -> Variants | None:
        i = (self.joint or 1) - 1
        return Variants(Acts(joint=i), wave(c.theta[:, i], np.ones(1)), ({"per_rev": 1.0},), 1.0)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return amplitude_and_phase("amplitude_deg", "deg", 180.0 / np.pi, amplitudes, covariance)


class GearCyclic(Effect):
    id = "gear_cyclic"
    physics = "Teeth and bearings of motor and reducer repeat their error n times a turn of the joint."
    remedy = "Check the reducer stage that turns n times a joint turn, or keep the term in the model."
    experiment = "Read finely over two or three periods of the joint angle."

    LOWEST, HIGHEST = 4.0, 80.0

    def variants(self, c: Conditions) -> Variants | None:
        i = (self.joint or 1) - 1
        span = float(np.ptp(c.theta[:, i]))
        if span <= 0.0:
            return None
        # below about one and a half periods over the visited range a ripple is a smooth curve
        lowest = max(self.LOWEST, 1.5 * 2.0 * np.pi / span)
        if lowest >= self.HIGHEST:
            return None
        step = 2.0 * np.pi / span / OVERSAMPLING
        n = np.arange(lowest, self.HIGHEST, step)
        whole = np.arange(np.ceil(lowest), self.HIGHEST + 1)
        n = np.unique(np.concatenate([n, whole]))
        return Variants(
            Acts(joint=i),
            wave(c.theta[:, i], n),
            tuple({"per_rev": float(v)} for v in n),
            (self.HIGHEST - lowest) * span / (2.0 * np.pi) * 2.0,
        )

    def refined(self, hidden: Mapping[str, float], c: Conditions) -> Mapping[str, tuple[float, float]]:
        step = 2.0 * np.pi / float(np.ptp(c.theta[:, (self.joint or 1) - 1])) / OVERSAMPLING
        n = hidden["per_rev"]
        return {"per_rev": (n - 2 * step, n + 2 * step)}

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return np.asarray(wave(c.theta[:, (self.joint or 1) - 1], np.array([hidden["per_rev"]]))[0])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (
            *amplitude_and_phase("amplitude_deg", "deg", 180.0 / np.pi, amplitudes, covariance),
            Quantity("per_rev", hidden["per_rev"], hidden.get("per_rev_sd", 0.0), "1/rev"),
        )
