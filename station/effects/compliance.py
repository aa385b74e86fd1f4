"""Wind-up of the drive train under the arm's weight."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from station.effects.base import Acts, Bounds, JointEffect, Variants, scaled
from station.errors import InputRefused
from station.mechanism import Conditions
from station.messages import effect_name
from station.records import Quantity, Real, phrase

SPREAD_RAD = 1e-3
"""Initial scatter of the sag under each of several masses."""


class Compliance(JointEffect):
    id = "compliance"
    physics = phrase("compliance_physics")
    remedy = phrase("compliance_remedy")
    experiment = phrase("compliance_experiment")
    bounds: ClassVar[Bounds] = dict.fromkeys(
        ("deg_at_horizontal", "deg_at_horizontal_per_kg", "deg_at_full_reach"), (0.0, 1.0)
    )

    def variants(self, c: Conditions) -> Variants | None:
        i = self.index
        known = {"by_payload": 1.0} if c.payload_kg is not None and np.ptp(c.payload_kg) > 0 else {}
        basis = self.at(known, c)
        if not np.ptp(basis, axis=0).any():
            return None
        # several positions of a mass are nearly equivalent: only a prior distinguishes them
        spread = None if c.load[i].shape[1] == 1 else np.full(basis.shape[1], SPREAD_RAD)
        return Variants(Acts(joint=i), basis[None], (known,), 1.0, spread)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        sag = c.load[self.index]
        if "by_payload" not in hidden:
            return sag
        if c.payload_kg is None:
            name = effect_name(self.label, "en")
            raise InputRefused(f"{name} was learned on payloads: a column payload_kg is needed.")
        return np.hstack([sag, sag * c.payload_kg[:, None]])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        names = (("deg_at_horizontal", "deg"), ("deg_at_horizontal_per_kg", "deg/kg"))
        if len(amplitudes) > 1 and "by_payload" not in hidden:
            # the position of the weight along the arm is hardly visible; the sum of the effects is
            whole, variance = float(amplitudes.sum()), float(covariance.sum())
            # the load of an arm is gravity's own moment about each axis: sag has the sign of the moment
            return (scaled("deg_at_full_reach", whole, variance, 180.0 / np.pi, "deg"),)
        return tuple(
            scaled(name, a, covariance[k, k], -180.0 / np.pi, unit)
            for k, (a, (name, unit)) in enumerate(zip(amplitudes, names, strict=False))
        )
