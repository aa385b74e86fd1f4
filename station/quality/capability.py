"""Process capability: how many standard deviations lie between the process and its limits.

Cpk uses the standard deviation from one value to the next, Ppk that of all values.  The confidence limits of
an index are Bissell's (1990): sd^2 = 1 / (9 n) + index^2 / (2 dof).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.quality.control_chart import sd_of_moving_range
from station.records import Real

K95 = 1.959964
MOVING_RANGE_DOF = 0.62
"""Degrees of freedom of the mean moving range, for each value except one: its relative variance is 0.826 / (n
- 1), that of a standard deviation 0.5 over its degrees of freedom (Cryer and Ryan 1990).
"""


@dataclass(frozen=True)
class Limits:
    """Limits of a value; None: no limit on that side."""

    low: float | None
    high: float | None


@dataclass(frozen=True)
class Index:
    """A capability index with its 95 % confidence limits."""

    value: float
    low: float
    high: float


def index(mean: float, sd: float, limits: Limits) -> float:
    """Distance of the mean from the nearer limit, over three standard deviations."""
    gaps = [mean - limits.low] if limits.low is not None else []
    gaps += [limits.high - mean] if limits.high is not None else []
    return min(gaps) / (3.0 * sd)


def with_confidence(value: float, count: int, dof: float) -> Index:
    """Bissell's limits of an index from `count` values, its standard deviation with `dof`."""
    half = K95 * float(np.sqrt(1.0 / (9.0 * count) + value**2 / (2.0 * dof)))
    return Index(value, value - half, value + half)


def cpk(values: Real, limits: Limits) -> Index | None:
    """Cpk of values (N,) in order; None if they do not scatter or are too few."""
    count = len(values)
    sd = sd_of_moving_range(values)
    if count < 3 or not sd > 0.0:
        return None
    return with_confidence(index(float(values.mean()), sd, limits), count, MOVING_RANGE_DOF * (count - 1))


def ppk(values: Real, limits: Limits) -> Index | None:
    """Ppk of values (N,) in any order; None if they do not scatter or are too few."""
    count = len(values)
    if count < 3 or not (sd := float(values.std(ddof=1))) > 0.0:
        return None
    return with_confidence(index(float(values.mean()), sd, limits), count, count - 1)
