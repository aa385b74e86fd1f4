"""Medians and spread over simulated machines."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from station.records import Real

Spread = dict[str, float]
"""{median, p5, p95}"""


def spread(values: Sequence[float] | Real) -> Spread:
    """Median, 5th and 95th percentile."""
    p5, median, p95 = np.percentile(values, (5, 50, 95))
    return {"median": float(median), "p5": float(p5), "p95": float(p95)}


def median_error(values: Sequence[float] | Real) -> float:
    """Standard error of the median, by bootstrap."""
    sample = np.asarray(values)
    drawn = np.random.default_rng(0).choice(sample, (500, len(sample)))
    return float(np.median(drawn, axis=1).std())
