"""The noise of the readings, and whether the model fits within it.

Pure error comes from readings with the same position, approach and mount: a missing effect acts on all of
them equally, so their scatter about their own mean is only noise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import chdtrc, fdtrc, ndtri, stdtrit

from station.fitting.least_squares import Solution
from station.records import Measurements, NoiseOfReadings, Real

MINIMUM_DOF = 8
"""Fewer repeats are weaker evidence on the noise than the specification."""
FEWEST_REPEATS = 6
"""Degrees of freedom; fewer repeats are not a sufficient reference for a residual."""
REFUSED_P = 1e-3
"""Probability that fresh readings refuse a true model."""


@dataclass(frozen=True)
class Noise:
    """The standard deviation of each row, and its source."""

    row_sd: Real
    """(K,) mm."""
    source: Literal["repeats", "specification"]
    dof: int
    """Degrees of freedom of the repeats; 0 if the specification was used."""

    @property
    def sigma_mm(self) -> float:
        """Root mean square over the rows."""
        return float(np.sqrt(np.mean(self.row_sd**2)))

    @property
    def coverage_factor(self) -> float:
        """k of the 95 % interval: Student's t for the repeats' degrees of freedom (GUM, G.3)."""
        return float(stdtrit(self.dof, 0.975)) if self.dof else float(ndtri(0.975))

    def record(self) -> NoiseOfReadings:
        """The noise as documents contain it."""
        return NoiseOfReadings(sigma_mm=self.sigma_mm, source=self.source, dof=self.dof)


def pure_error(measurements: Measurements, whitened: Real) -> tuple[float, int]:
    """Sum of squares of whitened residuals (K,) about the mean of their repeats, and its dof."""
    group = measurements.repeat_group
    counts = np.bincount(group)
    mean = np.bincount(group, whitened) / counts
    return float(np.sum((whitened - mean[group]) ** 2)), int(np.sum(counts - 1))


def chance_of(square: float, count: int, dof: int) -> float:
    """Probability of a sum of squares at least this large of `count` numbers, over their standard deviations.

    :param dof: degrees of freedom of the repeats that determined the noise (F); 0: the noise is known
    (chi-square)
    """
    return float(fdtrc(count, dof, square / count)) if dof else float(chdtrc(count, square))


def specified_noise(row_sd: Real) -> Noise:
    """Noise of rows (R,) that scatter as specified."""
    return Noise(row_sd, "specification", 0)


def estimate_noise(measurements: Measurements, whitened: Real, row_sd: Real) -> Noise:
    """Scale the specified row_sd (K,) to the repeats when there are enough of them."""
    square, dof = pure_error(measurements, whitened)
    if dof < MINIMUM_DOF or square == 0.0:
        return specified_noise(row_sd)
    return Noise(row_sd * np.sqrt(square / dof), "repeats", dof)


def lack_of_fit(
    solution: Solution, noise: Noise, free: int, measurements: Measurements
) -> tuple[float, float]:
    """p-value of the fit against the noise, and the ratio of residual scatter to noise (at least 1).

    The posterior cost of a true model is chi-square with R - `free` degrees of freedom, `free` being the
    unknowns without a prior.  With repeats the pure error is subtracted from it and the quotient is
    F-distributed.
    """
    dof = len(solution.residual) - free
    ratio = float(np.sqrt(max(solution.cost / dof, 1.0)))
    if noise.source == "specification":
        return float(chdtrc(dof, solution.cost)), ratio
    pure, pure_dof = pure_error(measurements, solution.residual)
    lack, lack_dof = max(solution.cost - pure, 0.0), dof - pure_dof
    if lack_dof <= 0:
        return 1.0, 1.0
    return float(fdtrc(lack_dof, pure_dof, (lack / lack_dof) / (pure / pure_dof))), ratio
