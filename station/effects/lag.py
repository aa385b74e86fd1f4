"""Readings that do not belong to the same moment as the recorded joint angles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from station.effects.base import Acts, Bounds, Effect, JointEffect, Variants, one, scaled
from station.errors import InputRefused
from station.mechanism import Conditions
from station.records import Quantity, Real, phrase

IN_ROWS = "in_rows"
"""Hidden parameter of a delay that was learned without times."""
PERCENT = -100.0
"""A lag of 1 % leaves a hundredth of the motion missing."""


class Lag(Effect):
    """A share of the motion from the previous pose, the same for all joints."""

    id = "lag"
    physics = phrase("lag_physics")
    remedy = phrase("lag_remedy")
    experiment = phrase("lag_experiment")
    bounds: ClassVar[Bounds] = {"lag_percent": (-50.0, 50.0)}

    def variants(self, c: Conditions) -> Variants | None:
        if c.step is None or not c.step.any():
            return None
        return one(Acts(motion="step"), np.ones(len(c)))

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        return (scaled("lag_percent", amplitudes[0], covariance[0, 0], PERCENT, "%"),)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        return np.ones((len(c), 1))


class JointLag(JointEffect):
    """The same of one joint; a reading that is taken too early lags in all of them."""

    id = Lag.id
    physics = Lag.physics
    remedy = Lag.remedy
    experiment = Lag.experiment
    bounds = Lag.bounds
    rare = True

    def variants(self, c: Conditions) -> Variants | None:
        if c.step is None or not c.step[:, self.index].any():
            return None
        return one(Acts(joint=self.index), c.step[:, self.index])

    quantities = Lag.quantities


class Delay(Effect):
    """A time between angles and reading, while the arm moves on from reading to reading."""

    id = "delay"
    physics = phrase("delay_physics")
    remedy = phrase("delay_remedy")
    experiment = phrase("delay_experiment")
    bounds: ClassVar[Bounds] = {"delay_ms": (-5_000.0, 5_000.0), "delay_percent": (-100.0, 100.0)}

    def __init__(self, *, timed: bool) -> None:
        self.timed = timed

    def variants(self, c: Conditions) -> Variants | None:
        if c.speed is None or not c.speed.any():
            return None
        hidden = {} if self.timed else {IN_ROWS: 1.0}
        return Variants(Acts(motion="speed"), np.ones((1, len(c), 1)), (hidden,), 1.0)

    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        name, factor, unit = ("delay_ms", -1e3, "ms") if self.timed else ("delay_percent", -1e2, "%")
        return (scaled(name, amplitudes[0], covariance[0, 0], factor, unit),)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        if (IN_ROWS in hidden) == self.timed:
            learned, here = ("without", "with") if self.timed else ("with", "without")
            raise InputRefused(
                f"{self.label} was learned on a log {learned} times; this log is {here} them: diagnose it "
                "by itself."
            )
        return np.ones((len(c), 1))
