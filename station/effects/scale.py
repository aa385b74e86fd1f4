"""Errors of the linear scale and its guide."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.effects.base import ON_READING, Effect, Variants, amplitude_and_phase, one, scaled
from station.effects.cyclic import OVERSAMPLING, wave, waves
from station.mechanism import Conditions
from station.records import Flags, Quantity, Real, phrase


class ScaleGain(Effect):
    id = "scale_gain"
    physics = phrase("scale_gain_physics")
    remedy = phrase("scale_gain_remedy")
    experiment = phrase("scale_gain_experiment")

    def variants(self, c: Conditions) -> Variants | None:
        return one(ON_READING, c.travel)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("ppm", amplitudes[0], covariance[0, 0], 1e6, "ppm"),)


class ScaleBow(Effect):
    id = "scale_bow"
    physics = phrase("scale_bow_physics")
    remedy = phrase("scale_bow_remedy")
    experiment = phrase("scale_bow_experiment")

    REACH_MM = 100.0
    """Travel from the middle at which the size is stated, about the limit of the workspace."""

    def variants(self, c: Conditions) -> Variants | None:
        centres = (0.0, float(c.travel.min() + c.travel.max()) / 2.0)
        basis = np.stack([self._square(c, centre)[:, None] for centre in centres])
        return Variants(ON_READING, basis, tuple({"centre_mm": v} for v in centres), 2.0)

    def refined(self, hidden: Mapping[str, float], c: Conditions) -> Mapping[str, tuple[float, float]]:
        return {"centre_mm": (hidden["centre_mm"] - 60.0, hidden["centre_mm"] + 60.0)}

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return self._square(c, hidden["centre_mm"])[:, None]

    def _square(self, c: Conditions, centre: float) -> Real:
        return np.asarray(((c.travel - centre) / self.REACH_MM) ** 2)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("mm_at_100_mm", amplitudes[0], covariance[0, 0], 1.0, "mm"),)


class ScaleCyclic(Effect):
    id = "scale_cyclic"
    physics = phrase("scale_cyclic_physics")
    remedy = phrase("scale_cyclic_remedy")
    experiment = phrase("scale_cyclic_experiment")

    repeats = True
    SHORTEST_MM = 0.4

    def variants(self, c: Conditions) -> Variants | None:
        span = float(np.ptp(c.travel))
        if span < 4.0 * self.SHORTEST_MM:
            return None
        frequency = np.arange(2.0 / span, 1.0 / self.SHORTEST_MM, 1.0 / span / OVERSAMPLING)
        return Variants(
            ON_READING,
            waves(c.travel, 2.0 * np.pi * frequency[0], 2.0 * np.pi / span / OVERSAMPLING, len(frequency)),
            tuple({"period_mm": float(1.0 / f)} for f in frequency),
            2.0 * span / self.SHORTEST_MM,
        )

    def refined(self, hidden: Mapping[str, float], c: Conditions) -> Mapping[str, tuple[float, float]]:
        frequency, step = 1.0 / hidden["period_mm"], 1.0 / float(np.ptp(c.travel)) / OVERSAMPLING
        return {"period_mm": (1.0 / (frequency + 2 * step), 1.0 / max(frequency - 2 * step, step))}

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return wave(c.travel, 2.0 * np.pi / hidden["period_mm"])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (
            *amplitude_and_phase("amplitude_mm", "mm", 1.0, amplitudes, covariance),
            Quantity("period_mm", hidden["period_mm"], hidden.get("period_mm_sd", 0.0), "mm"),
        )


class ScaleHysteresis(Effect):
    id = "scale_hysteresis"
    physics = phrase("scale_hysteresis_physics")
    remedy = phrase("scale_hysteresis_remedy")
    experiment = phrase("scale_hysteresis_experiment")

    def variants(self, c: Conditions) -> Variants | None:
        if len(np.unique(c.slider_direction[c.slider_direction != 0])) < 2:
            return None
        basis = np.stack([c.slider_direction[:, None], c.slider_net[:, None]])
        return Variants(ON_READING, basis, ({"last_motion": 1.0}, {"net_travel": 1.0}), 1.5)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return (c.slider_direction if "last_motion" in hidden else c.slider_net)[:, None]

    def doubtful(self, c: Conditions) -> Flags:
        """Readings where the slider reversed during the motion, or the motion is unknown."""
        return np.asarray((c.slider_direction != c.slider_net) | (c.slider_direction == 0))

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("width_mm", amplitudes[0], covariance[0, 0], -2.0, "mm"),)
