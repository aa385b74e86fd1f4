"""Backlash between a gear's output and its arm."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from station.effects.base import Acts, Bounds, JointEffect, Variants, one, scaled
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase


class Backlash(JointEffect):
    id = "backlash"
    physics = phrase("backlash_physics")
    remedy = phrase("backlash_remedy")
    experiment = phrase("backlash_experiment")
    by_approach = True
    bounds: ClassVar[Bounds] = {"width_deg": (0.0, 1.0)}

    def variants(self, c: Conditions) -> Variants | None:
        i = self.index
        if len(np.unique(c.approach[:, i][c.approach[:, i] != 0])) < 2:
            return None
        return one(Acts(joint=i), c.approach[:, i])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("width_deg", amplitudes[0], covariance[0, 0], -2.0 * 180.0 / np.pi, "deg"),)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return c.approach[:, [self.index]]
