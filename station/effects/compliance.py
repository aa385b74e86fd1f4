"""Wind-up of the drive train under the arm's weight."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from station.effects.base import Acts, Conditions, Effect, Variants, scaled
from station.errors import InputRefused
from station.kinematics import Real
from station.records import Quantity


class Compliance(Effect):
    id = "compliance"
    physics = "The arm sags under gravity, most when it is horizontal; a recorded payload adds to it."
    remedy = "Stiffen the drive train or compensate for the torque in the controller."
    experiment = "Repeat the walk with a payload on the platform."

    def variants(self, c: Conditions) -> Variants | None:
        i = (self.joint or 1) - 1
        known = {"by_payload": 1.0} if c.payload_kg is not None and np.ptp(c.payload_kg) > 0 else {}
        return Variants(Acts(joint=i), self.at(known, c)[None], (known,), 1.0)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        sag = np.cos(c.theta[:, (self.joint or 1) - 1])
        if "by_payload" not in hidden:
            return np.asarray(sag[:, None])
        if c.payload_kg is None:
            raise InputRefused(f"{self.label} was learned on payloads: a column payload_kg is needed.")
        return np.column_stack([sag, sag * c.payload_kg])

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        names = (("deg_at_horizontal", "deg"), ("deg_at_horizontal_per_kg", "deg/kg"))
        return tuple(
            scaled(name, a, covariance[k, k], -180.0 / np.pi, unit)
            for k, (a, (name, unit)) in enumerate(zip(amplitudes, names, strict=False))
        )
