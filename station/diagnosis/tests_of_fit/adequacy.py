"""Whether a fit is good enough to stop: lack of fit, order, smooth departures, repeats, tolerances.

Null hypothesis of each test: the residual is noise. The repeats' own scatter is the reference for the
residual; where something changes with time it is too large itself, and few repeats are a poor reference.
Therefore the other tests are used as well.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc, fdtrc, ndtr

from station.diagnosis.tests_of_fit.smooth_departures import departures, whitened_residual
from station.fitting import FEWEST_REPEATS
from station.mechanism import axis_of_row
from station.model import Fit
from station.records import Real

ALPHA = 5e-4
"""Level of each test: a machine without a defect is searched in two of a thousand runs."""
TENSION = 1e-4
"""Tolerances are less exact than noise: only a clear contradiction counts."""
LOUD = 3.0
"""Repeats with this many times the specified scatter are a fault by themselves: any model fits them."""


@dataclass(frozen=True)
class Adequacy:
    """p-values of the tests and the pure error they used."""

    lack_of_fit_p: float
    order_in_time_p: float
    repeats_p: float
    """p-value of the repeats against the specification."""
    pure_factor: float
    """Pure error over the row_sd of the fit; NaN without enough repeats."""
    pure_dof: int
    loudness: float
    """Pure error over the specification; NaN without enough repeats."""
    departure_p: float
    """p-value of the most significant smooth departure, with the price of all of them included."""
    tension_p: float
    """p-value of the parameters against their tolerances: a model may fit by bending known values."""

    @property
    def passed(self) -> bool:
        """Whether it passes the tests that a somewhat noisier head alone does not fail."""
        fits = min(self.lack_of_fit_p, self.order_in_time_p, self.departure_p) >= ALPHA
        return fits and not self.loud and self.tension_p >= TENSION

    @property
    def settled(self) -> bool:
        """Whether nothing remains to be searched, neither in the fit nor in the repeats."""
        return self.passed and self.quiet

    @property
    def loud(self) -> bool:
        """Whether repeats scatter far more than specified."""
        return self.loudness > LOUD

    @property
    def quiet(self) -> bool:
        """Whether repeats scatter no more than specified."""
        return self.repeats_p >= ALPHA


def judge(fit: Fit, specified_sd: Real) -> Adequacy:
    """Test a fit's residual; specified_sd (K,) mm is the devices' guaranteed limit."""
    r = fit.residual_mm
    group = _repeat_groups(fit)
    spec_ratio = float(np.mean((fit.row_sd / specified_sd) ** 2))
    counts = np.bincount(group)
    mean = np.bincount(group, r / fit.row_sd) / counts
    pure = float(np.sum((r / fit.row_sd - mean[group]) ** 2))
    dof = int(np.sum(counts - 1))
    known = dof >= FEWEST_REPEATS and pure > 0.0
    against_spec = pure * spec_ratio
    repeats_p = float(chdtrc(dof, against_spec)) if known else 1.0
    lack_p = _lack_of_fit_p(fit, pure, dof) if known else 1.0
    if repeats_p >= ALPHA:
        # a few repeats are weak evidence; if no worse than specified, the specification is used
        lack_p = min(lack_p, float(chdtrc(fit.dof, fit.cost * spec_ratio)))
    return Adequacy(
        lack_of_fit_p=lack_p,
        order_in_time_p=_order_p(fit, r / fit.row_sd),
        repeats_p=repeats_p,
        pure_factor=float(np.sqrt(pure / dof)) if known else float("nan"),
        pure_dof=dof,
        loudness=float(np.sqrt(against_spec / dof)) if known else float("nan"),
        departure_p=_departure_p(fit),
        tension_p=_tension_p(fit),
    )


def _departure_p(fit: Fit) -> float:
    found = departures(whitened_residual(fit))
    return min(1.0, len(found) * min(d.p_value for d in found))


def _tension_p(fit: Fit) -> float:
    """Chi-square of the parameters under their prior; conservative: the readings determine only some."""
    pull = fit.prior.root @ (fit.x - fit.prior.mean)
    return float(chdtrc(len(pull), float(pull @ pull)))


def _repeat_groups(fit: Fit) -> np.ndarray:
    """(R,) group of rows with the same position, approach, mount, slider's sense and coordinate."""
    m, reading = fit.model.mechanism.measurements, fit.model.mechanism.reading_of_row
    keys = np.column_stack([m.repeat_group, fit.conditions.slider_net])[reading]
    keys = np.column_stack([keys, axis_of_row(fit.model.mechanism)])
    return np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)


def _lack_of_fit_p(fit: Fit, pure: float, pure_dof: int) -> float:
    lack_dof = fit.dof - pure_dof
    if lack_dof <= 0:
        return 1.0
    lack = max(fit.cost - pure, 0.0)
    return float(fdtrc(lack_dof, pure_dof, (lack / lack_dof) / (pure / pure_dof)))


def _order_p(fit: Fit, whitened: Real) -> float:
    """von Neumann's ratio of successive differences in time order, one-sided (neighbours too similar).

    Coordinates of one reading are tested separately and combined after Stouffer.
    """
    axis = axis_of_row(fit.model.mechanism)
    order = np.argsort(fit.model.mechanism.measurements.t_s, kind="stable")
    scores = [_order_score(whitened[axis == a][order]) for a in range(int(axis.max()) + 1)]
    return float(ndtr(np.sum(scores) / np.sqrt(len(scores))))


def _order_score(r: Real) -> float:
    """Standard score of the ratio; inf where there is too little to judge."""
    n = len(r)
    square = float(r @ r)
    if n < 12 or square == 0.0:
        return np.inf
    ratio = float(np.sum(np.diff(r) ** 2)) / square
    return float((ratio - 2.0) / np.sqrt(4.0 * (n - 2) / (n**2 - 1)))
