"""Whitened Gauss-Newton with Levenberg-Marquardt step control, SVD inside.

The problem is to minimise |r(x)|^2 + |W (x - m)|^2, where r is already divided by its standard
deviation and (m, W) is the prior.  Each step solves the linearised problem through the QR
factors of the scaled, stacked Jacobian and the SVD of R, so singular values and blind directions
come with the answer.  Converged means: the next full step is below `TOLERANCE` standard deviations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from station.kinematics import Real

TOLERANCE = 1e-7
MAX_STEPS = 60
BLIND = 1e-11
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

    :raises NotConvergedError: no convergence in `MAX_STEPS`, or not a number at the start.
    """
    x = start.astype(float)
    stacked, target, r, J = _stack(residuals, x, prior)
    cost = float(target @ target)
    if not np.isfinite(cost):
        raise NotConvergedError("the model cannot be evaluated at the starting values")
    damping = 0.0
    for step in range(1, MAX_STEPS + 1):
        scale = np.sqrt(np.einsum("ij,ij->j", stacked, stacked))
        scale[scale == 0.0] = 1.0
        R: Real = np.asarray(np.linalg.qr(np.column_stack([stacked / scale, target]), mode="r"))
        U, sigma, Vt = np.linalg.svd(R[:-1, :-1] if R.shape[0] > len(x) else R[:, :-1])
        projected = U.T @ R[: len(sigma), -1]
        sigma_safe = np.where(sigma > BLIND * sigma[0], sigma, np.inf)
        while True:
            along = projected * sigma_safe / (sigma_safe**2 + damping) if damping else projected / sigma_safe
            delta = -(Vt.T @ along) / scale
            trial = x + delta
            new_stacked, new_target, new_r, new_J = _stack(residuals, trial, prior)
            new_cost = float(new_target @ new_target)
            # rounding of the cost itself must not be mistaken for an uphill step
            if new_cost <= cost * (1.0 + 1e-10) + 1e-12:
                break
            if damping > 1e12:
                raise NotConvergedError(f"no downhill step was found after {step} steps")
            damping = max(10.0 * damping, 1e-4 * sigma[0] ** 2)
        length = float(np.linalg.norm(projected[np.isfinite(sigma_safe)]))
        x, stacked, target, r, J, cost = trial, new_stacked, new_target, new_r, new_J, new_cost
        if damping == 0.0 and length < TOLERANCE:
            half = Vt.T / sigma_safe
            covariance = (half @ half.T) / np.outer(scale, scale)
            lost = Vt[np.isinf(sigma_safe)]
            if lost.size:
                covariance[np.ix_(touched := np.abs(lost).max(0) > 1e-6, touched)] = np.inf
            return Solution(x, covariance, sigma, Vt, scale, cost, r, J, step)
        damping = damping / 10.0 if damping > 1e-8 * sigma[0] ** 2 else 0.0
    raise NotConvergedError(
        f"no convergence in {MAX_STEPS} steps; the last was {length:.2g} standard deviations"
    )


def _stack(residuals: Residuals, x: Real, prior: Prior) -> tuple[Real, Real, Real, Real]:
    """Rows of data above rows of prior: Jacobian (R + H, P), residual (R + H,), and the data's own."""
    r, J = residuals(x)
    return (
        np.concatenate([J, prior.root]),
        np.concatenate([r, prior.root @ (x - prior.mean)]),
        r,
        J,
    )
