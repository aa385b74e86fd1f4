"""The last model's residual as a smooth unnamed error of the pose.

A Gaussian process over the joint angles with the exponential covariance exp(-d / length): it assumes only
continuity (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, sections 2.2 and 5.4.1).
Length and size are those that make the residual most probable. It names no cause, and goes to zero away from
measured poses. It is used only if it predicts excluded blocks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from station.diagnosis.tests_of_fit import folds, left_without
from station.model import Fit
from station.records import Measurements, Real

LENGTHS_RAD = (0.5, 1.0, 2.0, 4.0)
SIZES = (0.1, 0.3, 1.0, 3.0)
"""Variance of the smooth error over that of noise."""
MOST_LOOKED_AT = 600
"""Number of readings, evenly spread, from which length and size are chosen,"""
MOST = 2500
"""and from which the error is learned: time grows with their cube."""
HELPFUL = 0.999
"""Error of excluded blocks over that without it, below which it is used."""


@dataclass(frozen=True)
class UnnamedError:
    """Learned on M poses of n joints; c coordinates of a reading."""

    theta: Real
    """(M, n) rad"""
    weight: Real
    """(M, c) mm"""
    length_rad: float
    size: float
    fitted_mm: Real
    """(K, c) residual at the readings learned on."""
    share: float
    """RMS error of excluded blocks over that without the smooth error."""

    def at(self, theta: Real) -> Real:
        """(L, c) mm, at poses theta (L, n)."""
        return np.asarray(_alike(theta, self.theta, self.length_rad) @ self.weight)


def unnamed_error(last: Fit) -> UnnamedError | None:
    """The error in the last fit's residual; None if it does not improve predictions of excluded blocks."""
    mechanism = last.model.mechanism
    m = mechanism.measurements
    left = last.residual_mm.reshape(len(m), -1)
    length, size = _most_probable(m.theta, left)
    fold = folds(m)
    out, remains = np.empty_like(left), np.empty_like(left)
    for f in np.unique(fold):
        own = fold == f
        without = left_without(last.solution, own[mechanism.reading_of_row]) * last.row_sd
        without = without.reshape(left.shape)
        theta, weight = _learned(m.theta[~own], without[~own], length, size)
        out[own] = without[own]
        remains[own] = without[own] - _alike(m.theta[own], theta, length) @ weight
    share = float(np.sqrt(np.sum(remains**2) / np.sum(out**2)))
    if not share < HELPFUL:
        return None
    theta, weight = _learned(m.theta, left, length, size)
    fitted = left - _alike(m.theta, theta, length) @ weight
    return UnnamedError(theta, weight, length, size, fitted, share)


def left_by(found: UnnamedError, fresh: Measurements, residual_mm: Real) -> Real:
    """(K,) mm, length of the remaining residual (R,) of fresh readings."""
    left = residual_mm.reshape(len(fresh), -1) - found.at(fresh.theta)
    return np.asarray(np.linalg.norm(left, axis=1))


def _most_probable(theta: Real, left: Real) -> tuple[float, float]:
    """Length and size by marginal likelihood, the noise integrated out."""
    some = slice(None, None, -(-len(theta) // MOST_LOOKED_AT))
    theta, left = theta[some], left[some]
    best, chosen = -np.inf, (LENGTHS_RAD[0], SIZES[0])
    for length in LENGTHS_RAD:
        alike = _alike(theta, theta, length)
        for size in SIZES:
            factor = cho_factor(size * alike + np.eye(len(theta)), lower=True)
            square = float(np.sum(left * cho_solve(factor, left))) / left.size
            log_likelihood = -0.5 * left.size * np.log(max(square, 1e-300))
            log_likelihood -= left.shape[1] * float(np.sum(np.log(np.diag(factor[0]))))
            if log_likelihood > best:
                best, chosen = log_likelihood, (length, size)
    return chosen


def _learned(theta: Real, left: Real, length: float, size: float) -> tuple[Real, Real]:
    """Poses (M, n) and weights (M, c)."""
    some = slice(None, None, -(-len(theta) // MOST))
    theta, left = theta[some], left[some]
    factor = cho_factor(size * _alike(theta, theta, length) + np.eye(len(theta)), lower=True)
    return theta, size * cho_solve(factor, left)


def _alike(a: Real, b: Real, length: float) -> Real:
    """(A, B) correlation of the error at poses a (A, n) and b (B, n)."""
    square = np.sum(a**2, axis=1)[:, None] + np.sum(b**2, axis=1) - 2.0 * a @ b.T
    return np.asarray(np.exp(-np.sqrt(np.maximum(square, 0.0)) / length))
