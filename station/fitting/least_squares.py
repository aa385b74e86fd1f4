"""Whitened Gauss-Newton with Levenberg-Marquardt step control, SVD inside.

The problem is to minimise |r(x)|^2 + |W (x - m)|^2, where r is already divided by its standard
deviation and (m, W) is the prior.  Converged means: the last step was shorter than `TOLERANCE`
standard deviations (each is at most a few hundredths of the one before).  Singular values and
blind directions come with the answer.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dposv

from station.records import Real

TOLERANCE = 3e-8
MAX_STEPS = 60
MISFIT = 5.0
"""Residuals this many standard deviations large come from a model that is wrong."""
LOOSE = 1e-3
"""Length of the last step then, per standard deviation of misfit."""
HUNDREDS = 1.0
"""Length of the last step of hundreds of unknowns together: a twentieth of a standard deviation each."""
CURVED_AFTER = 5
"""Steps of Gauss-Newton before every other one is made with the full Hessian, if residuals stay large."""
CRAWLING = 0.3
"""Length of a step over the one before, from which on that is worth its many evaluations."""
ROUNDING = 1e-7
"""Share of the cost that double precision may get wrong: distances are known to 1e-13 mm of 600."""
MANY = 100
"""Unknowns from which the shape of the minimum is taken from the normal matrix."""
BLIND = 1e-10
"""Singular values below this share of the largest carry no information in double precision."""

Residuals = Callable[[Real], tuple[Real, Real]]
"""x (P,) -> whitened residual (R,) and its Jacobian (R, P)."""


class NotConvergedError(ArithmeticError):
    """The fit did not converge; the text says how far it came."""


@dataclass(frozen=True)
class Prior:
    """What is known before the data: x ~ N(mean, inverse of root' root)."""

    mean: Real
    """(P,)"""
    root: Real
    """(H, P) W; an unknown without prior has a column of zeros."""

    @classmethod
    def independent(cls, mean: Real, sd: Real) -> Prior:
        """One standard deviation each, inf for none."""
        held = np.flatnonzero(np.isfinite(sd))
        root = np.zeros((len(held), len(sd)))
        root[np.arange(len(held)), held] = 1.0 / sd[held]
        return cls(mean, root)

    @property
    def free(self) -> int:
        """Number of unknowns that the prior says nothing about."""
        return len(self.mean) - len(self.root)


@dataclass(frozen=True)
class Solution:
    """The minimum and its shape."""

    x: Real
    covariance: Real
    """(P, P) posterior covariance; blind directions without a prior have infinite variance."""
    singular_values: Real
    """(P,) of the stacked Jacobian with unit columns, descending."""
    directions: Real
    """(P, P) rows: the matching directions in the scaled unknowns."""
    scale: Real
    """(P,) column norms used: x = direction / scale."""
    cost: float
    """|r|^2 + prior at the minimum."""
    residual: Real
    """(R,) whitened, without the prior rows."""
    jacobian: Real
    """(R, P) whitened, without the prior rows."""
    steps: int

    @property
    def blind(self) -> int:
        """Number of directions that neither data nor prior hold."""
        return int(np.sum(self.singular_values <= BLIND * self.singular_values[0]))


def solve(residuals: Residuals, start: Real, prior: Prior) -> Solution:
    """Minimise from `start` (P,).

    Steps come from the normal equations with unit columns: their rounding only slows a step, the
    residual and its gradient decide where the iteration ends.  The answer's shape comes from the
    SVD of the stacked Jacobian itself.

    :raises NotConvergedError: no convergence in `MAX_STEPS`, or not a number at the start.
    """
    with np.errstate(invalid="ignore"):
        return _solve(residuals, start, prior)


def _solve(residuals: Residuals, start: Real, prior: Prior) -> Solution:
    x = start.astype(float)
    stacked, target, r, J = _stack(residuals, x, prior)
    cost = float(target @ target)
    if not math.isfinite(cost):
        raise NotConvergedError("the model cannot be evaluated at the starting values")
    damping = 0.0
    length = before = math.inf
    for step in range(1, MAX_STEPS + 1):
        gradient = stacked.T @ target
        normal: Real = stacked.T @ stacked
        if step > CURVED_AFTER and step % 2 and cost > MISFIT**2 * len(r) and length > CRAWLING * before:
            # with large residuals Gauss-Newton crawls: its matrix lacks their curvature
            curved = _hessian(residuals, x, gradient, prior)
            normal = normal if curved is None else curved
        before = length
        scale = np.sqrt(normal.diagonal())
        scale[scale == 0.0] = 1.0
        normal /= scale
        normal /= scale[:, None]
        gradient /= scale
        while True:
            along = _descend(normal, gradient, damping)
            trial = x - along / scale
            length = math.sqrt(max(float(along @ gradient), 0.0))
            if damping == 0.0 and length < TOLERANCE:
                # nothing that was evaluated at x is different there
                return _shape(trial, stacked, r, J, cost, step)
            new_stacked, new_target, new_r, new_J = _stack(residuals, trial, prior)
            new_cost = float(new_target @ new_target)
            # rounding of the cost itself must not be mistaken for an uphill step
            if new_cost <= cost + ROUNDING * (1.0 + cost):
                break
            if damping > 1e12:
                raise NotConvergedError(f"no downhill step was found after {step} steps")
            damping = max(10.0 * damping, 1e-4)
        x, stacked, target, r, J, cost = trial, new_stacked, new_target, new_r, new_J, new_cost
        if damping == 0.0 and length < _tolerance(cost, len(r), len(x)):
            return _shape(x, stacked, r, J, cost, step)
        damping = damping / 10.0 if damping > 1e-8 else 0.0
    raise NotConvergedError(
        f"no convergence in {MAX_STEPS} steps; the last was {length:.2g} standard deviations"
    )


def _hessian(residuals: Residuals, x: Real, gradient: Real, prior: Prior) -> Real | None:
    """(P, P) of half the cost by differences of its gradient; None where it is not positive definite."""
    sd = 1.0 / np.linalg.norm(_stack(residuals, x, prior)[0], axis=0)
    columns = []
    for k, step in enumerate(sd):
        aside = x.copy()
        aside[k] += step
        stacked, target, _, _ = _stack(residuals, aside, prior)
        columns.append((stacked.T @ target - gradient) / step)
    hessian = np.column_stack(columns)
    hessian = (hessian + hessian.T) / 2.0
    unit = hessian * np.outer(sd, sd)
    return hessian if np.isfinite(unit).all() and np.linalg.eigvalsh(unit)[0] > 0.0 else None


def _tolerance(cost: float, rows: int, unknowns: int) -> float:
    """Neither a misfit far beyond the noise nor hundreds of unknowns are pinned down to a fraction of it."""
    misfit = math.sqrt(cost / rows)
    if unknowns >= MANY:
        return HUNDREDS * max(misfit, 1.0)
    return TOLERANCE if misfit < MISFIT else LOOSE * misfit


def _descend(normal: Real, gradient: Real, damping: float) -> Real:
    """Solve (normal + damping) step = gradient; blind directions are left alone."""
    damped = normal + damping * np.eye(len(normal)) if damping else normal
    _, step, info = dposv(damped, gradient)
    if info == 0:
        return np.asarray(step)
    values, vectors = np.linalg.eigh(damped)
    values = np.where(values > BLIND * values[-1], values, np.inf)
    return np.asarray(vectors @ ((vectors.T @ gradient) / values))


def _shape(x: Real, stacked: Real, r: Real, J: Real, cost: float, steps: int) -> Solution:
    scale = np.sqrt(np.einsum("kp,kp->p", stacked, stacked))
    scale[scale == 0.0] = 1.0
    sigma, Vt = _singular(stacked, scale)
    held = sigma > BLIND * sigma[0]
    half = Vt[held].T / sigma[held]
    covariance = (half @ half.T) / np.outer(scale, scale)
    if not held.all():
        lost = np.abs(Vt[~held]).max(axis=0) > 1e-6
        covariance[np.ix_(lost, lost)] = np.inf
    return Solution(x, covariance, sigma, Vt, scale, cost, r, J, steps)


def _singular(stacked: Real, scale: Real) -> tuple[Real, Real]:
    """Singular values, descending, and right singular vectors of a matrix, its columns divided by scale (P,).

    Of hundreds of columns by way of the normal matrix: it knows singular values to 1e-8 of the largest only,
    but a fit of so many has priors that keep them above that, and takes seconds less.
    """
    if stacked.shape[1] < MANY:
        _, sigma, Vt = np.linalg.svd(stacked / scale, full_matrices=False)
        return sigma, Vt
    square, vectors = np.linalg.eigh(stacked.T @ stacked / np.outer(scale, scale))
    return np.sqrt(np.maximum(square[::-1], 0.0)), vectors.T[::-1]


def _stack(residuals: Residuals, x: Real, prior: Prior) -> tuple[Real, Real, Real, Real]:
    """Rows of data above rows of prior: Jacobian (R + H, P), residual (R + H,), and the data's own."""
    r, J = residuals(x)
    if not len(prior.root):
        return J, r, r, J
    stacked, target = np.concatenate([J, prior.root]), np.concatenate([r, prior.root @ (x - prior.mean)])
    # views, so that the data's own are not kept twice
    return stacked, target, target[: len(r)], stacked[: len(r)]
