"""A step of the joint that its feedback does not detect."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from station.effects.base import Acts, Bounds, JointEffect, Variants, scaled
from station.errors import InputRefused
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase

FROM_READING = "from_reading"
"""Hidden parameter of a slip in a log without times."""
EDGE = 2
"""A step with fewer readings on one side is treated as outliers."""


MOST_MOMENTS = 200
"""In a long log not every reading is tried: a step's moment is then known to half a percent of it."""


class CountSlip(JointEffect):
    id = "count_slip"
    physics = phrase("count_slip_physics")
    remedy = phrase("count_slip_remedy")
    experiment = phrase("count_slip_experiment")
    bounds: ClassVar[Bounds] = {"step_deg": (-5.0, 5.0)}

    def __init__(self, joint: int, *, timed: bool = True) -> None:
        super().__init__(joint)
        self.since = ("from_s", "s") if timed else (FROM_READING, "")

    def variants(self, c: Conditions) -> Variants | None:
        if len(c) < 4 * EDGE:
            return None
        order = np.argsort(c.t_s, kind="stable")
        every = max(1, len(order) // MOST_MOMENTS)
        moments = c.t_s[order[EDGE : len(order) - EDGE + 1 : every]]
        basis = (c.t_s[None, :] >= moments[:, None]).astype(float)[:, :, None]
        return Variants(
            Acts(joint=self.index),
            basis,
            tuple({self.since[0]: float(t)} for t in moments),
            float(len(moments)) / 2.0,
        )

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        name = self.since[0]
        if name not in hidden:
            learned, here = ("without", "with") if name == "from_s" else ("with", "without")
            raise InputRefused(
                f"{self.label} was learned on a log {learned} times; this log is {here} them: diagnose it "
                "by itself."
            )
        return (c.t_s >= hidden[name]).astype(float)[:, None]

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (
            scaled("step_deg", amplitudes[0], covariance[0, 0], 180.0 / np.pi, "deg"),
            Quantity(self.since[0], hidden[self.since[0]], 0.0, self.since[1]),
        )
