"""Wind-up of the drive train under the arm's weight."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.effects.base import Acts, Conditions, Effect, Variants, one, scaled
from station.kinematics import Real
from station.records import Quantity


class Compliance(Effect):
    id = "compliance"
    physics = "The arm sags under gravity, most when it is horizontal; a recorded payload adds to it."
    remedy = "Stiffen the drive train or compensate for the torque in the controller."
    experiment = "Repeat the walk with a payload on the platform."

    def variants(self, c: Conditions) -> Variants | None:
        i = (self.joint or 1) - 1
        sag = np.cos(c.theta[:, i])
        if c.payload_kg is not None and np.ptp(c.payload_kg) > 0:
            return one(Acts(joint=i), np.column_stack([sag, sag * c.payload_kg]))
        return one(Acts(joint=i), sag)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        names = (("deg_at_horizontal", "deg"), ("deg_at_horizontal_per_kg", "deg/kg"))
        return tuple(
            scaled(name, a, covariance[k, k], -180.0 / np.pi, unit)
            for k, (a, (name, unit)) in enumerate(zip(amplitudes, names, strict=False))
        )
