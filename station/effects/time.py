"""Effects of time and temperature."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from station.effects.base import ON_READING, Acts, Bounds, Effect, Variants, one, scaled
from station.errors import InputRefused
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase


class Drift(Effect):
    id = "drift"
    physics = phrase("drift_physics")
    remedy = phrase("drift_remedy")
    experiment = phrase("drift_experiment")

    def variants(self, c: Conditions) -> Variants | None:
        return one(ON_READING, c.t_s)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("mm_per_hour", amplitudes[0], covariance[0, 0], 3600.0, "mm/h"),)


class ThermalGrowth(Effect):
    id = "thermal_growth"
    physics = phrase("thermal_growth_physics")
    remedy = phrase("thermal_growth_remedy")
    experiment = phrase("thermal_growth_experiment")
    bounds: ClassVar[Bounds] = {
        "links_um_per_m_per_K": (0.0, 40.0),
        "scale_um_per_m_per_K": (-40.0, 40.0),
        "links_um_per_m": (0.0, 2_000.0),
    }

    WARMED = ("links", "scale", "mounting")
    TIME_CONSTANTS = 24

    def variants(self, c: Conditions) -> Variants | None:
        if c.temperature_rise is not None:
            return self._stack(c, [({}, c.temperature_rise)], 3.0)
        # without a thermometer: exponential in time, tau over two decades about the sequence's duration
        duration = float(np.ptp(c.t_s))
        if duration <= 0.0:
            return None
        taus = duration * np.geomspace(0.05, 3.0, self.TIME_CONSTANTS)
        return self._stack(c, [({"tau_s": float(tau)}, _warming(c.t_s, tau)) for tau in taus], 8.0)

    def _stack(self, c: Conditions, courses: list[tuple[dict[str, float], Real]], trials: float) -> Variants:
        """Growth of the scale (in proportion to its travel) and of its mounting act on the reading."""
        basis, hidden = [], []
        for known, course in courses:
            for part, factor in (("scale", c.travel), ("mounting", np.ones(len(c)))):
                basis.append((course * factor)[:, None])
                hidden.append({**known, part: 1.0})
        return Variants(ON_READING, np.stack(basis), tuple(hidden), trials)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        course = c.temperature_rise if "tau_s" not in hidden else _warming(c.t_s, hidden["tau_s"])
        if course is None:
            raise InputRefused(
                "Thermal growth was learned on temperatures: a column temperature_c is needed."
            )
        return (course * (c.travel if "scale" in hidden else 1.0))[:, None]

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        part = next(name for name in self.WARMED if name in hidden)
        recorded = "tau_s" not in hidden
        factor, unit = (1e6, "um/m/K") if recorded else (1e6, "um/m")
        if part == "mounting":
            factor, unit = (1e3, "um/K") if recorded else (1.0, "mm")
        name = f"{part}_{unit.replace('/', '_per_')}"
        size = scaled(name, amplitudes[0], covariance[0, 0], factor, unit)
        return (size,) if recorded else (size, Quantity("tau_s", hidden["tau_s"], 0.0, "s"))


class ThermalLinks(ThermalGrowth):
    """The same effect acting on the links."""

    @property
    def label(self) -> str:
        return f"{self.id} of the links"

    def _stack(self, c: Conditions, courses: list[tuple[dict[str, float], Real]], trials: float) -> Variants:
        return Variants(
            Acts(lengths=dict(c.lengths)),
            np.stack([course[:, None] for _, course in courses]),
            tuple({**known, "links": 1.0} for known, _ in courses),
            trials,
        )


def _warming(t_s: Real, tau_s: float) -> Real:
    return np.asarray(1.0 - np.exp(-(t_s) / tau_s))
