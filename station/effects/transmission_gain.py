"""A reducer or belt whose ratio differs from the drive's setting."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from station.effects.base import Acts, Bounds, JointEffect, Variants, one, scaled
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase


class TransmissionGain(JointEffect):
    id = "transmission_gain"
    physics = phrase("transmission_gain_physics")
    remedy = phrase("transmission_gain_remedy")
    experiment = phrase("transmission_gain_experiment")
    bounds: ClassVar[Bounds] = {"ppm": (-12_000.0, 12_000.0)}

    def variants(self, c: Conditions) -> Variants | None:
        i = self.index
        return one(Acts(joint=i), c.drive_angle[:, i])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("ppm", amplitudes[0], covariance[0, 0], 1e6, "ppm"),)
