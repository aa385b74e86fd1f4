"""Readings that disagree with all others: found, named, left out with a reason, never silently.

A reading is an outlier only when it also disagrees with the other readings of its own place: an
effect at a place (a dent, a cable) shows in all of them and must not be thrown away.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import stats

from station.errors import InputRefused
from station.kinematics import Real
from station.least_squares import Solution
from station.measurements import Measurements

SIGNIFICANCE = 1e-3
"""For the whole set of readings (Bonferroni)."""
LARGEST_SHARE = 0.1
FEW = 15
"""Below this many readings their own scatter cannot be trusted to be smaller than specified."""


@dataclass(frozen=True)
class Outlier:
    """One reading left out."""

    reading: int | str
    residual_mm: float
    times_sd: float

    @property
    def reason(self) -> str:
        return f"off by {self.residual_mm * 1e3:.0f} um, {self.times_sd:.0f} times the scatter of the others"

    def as_json(self) -> dict[str, Any]:
        return {"reading": self.reading, "residual_mm": self.residual_mm, "reason": self.reason}


def find(measurements: Measurements, solution: Solution, row_sd: Real) -> Outlier | None:
    """The worst outlying reading of a fit, or None.  `row_sd` (K,) whitened the fit."""
    residual = -solution.residual
    finite = np.isfinite(np.diag(solution.covariance))
    J, C = solution.jacobian[:, finite], solution.covariance[np.ix_(finite, finite)]
    left = 1.0 - np.einsum("ki,ij,kj->k", J, C, J)
    # a reading that alone determines a parameter cannot be judged
    judged = left > 0.05
    t = np.where(judged, residual / np.sqrt(np.where(judged, left, 1.0)), 0.0)
    scale = 1.4826 * float(np.median(np.abs(t[judged]))) if judged.any() else 1.0
    if len(measurements) < FEW:
        scale = max(scale, 1.0)
    limit = float(stats.norm.isf(SIGNIFICANCE / (2 * len(measurements)))) * scale
    for k in np.argsort(-np.abs(t)):
        if abs(t[k]) <= limit:
            return None
        companions = np.flatnonzero(measurements.position == measurements.position[k])
        companions = companions[companions != k]
        apart = abs(residual[k] - np.mean(residual[companions])) if companions.size else np.inf
        if apart > limit:
            return Outlier(measurements.ids[k], float(residual[k] * row_sd[k]), float(abs(t[k]) / scale))
    return None


def check_share(left_out: tuple[Outlier, ...], readings: int) -> None:
    """:raises InputRefused: more than a tenth of the readings (at least one) would be left out."""
    if len(left_out) > max(1, int(LARGEST_SHARE * readings)):
        names = ", ".join(str(o.reading) for o in left_out)
        raise InputRefused(
            f"Readings {names} disagree with the rest, more than a tenth of {readings}; "
            "measure again and check the scale and its mounting."
        )
