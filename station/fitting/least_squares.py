"""Whitened least squares by trust-region steps.

The problem is to minimise |r(x)|^2 + |W (x - m)|^2, where r is already divided by its standard deviation and
(m, W) is the prior.  A step is the Gauss-Newton step where that is no longer than the trust radius, otherwise
the Levenberg-Marquardt step of that length, bent along its valley (More 1978; Transtrum and Sethna 2012).
The radius follows the gain ratio: actual over predicted reduction of the cost.

The iteration ends where a Gauss-Newton step would gain next to nothing.  `status` and `message` state how it
ended, and `gain_left` the remaining reduction. A solution that stopped early is valid too: its covariance is
widened by the step that was not made.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.linalg.lapack import dposv

from station.records import Real

TOLERANCE = 3e-8
"""Length of the undamped step, in standard deviations, that counts as zero."""
NEGLIGIBLE = 1e-6
"""Remaining distance, per standard deviation of misfit, that is not worth further slow steps."""
MAX_STEPS = 250
HUNDREDS = 1.0
"""Length of the last step for hundreds of unknowns together: a twentieth of a standard deviation each."""
SLOW_AFTER = 5
"""Number of steps before slow convergence is checked."""
SLOW = 0.3
"""Ratio of successive step lengths above which Gauss-Newton lacks the curvature of large residuals."""
ROUNDING = 1e-7
"""Rounding error of the cost in double precision, as a share: distances are known to 1e-13 mm of 600."""
GOOD, POOR = 0.75, 0.25
"""Gain ratios above which steps may be longer, and below which they must be shorter,"""
LONGER, SHORTER = 2.0, 0.5
"""by these factors."""
NEAR = 0.2
"""Share by which the length of a step may differ from the radius."""
MOST_ROUNDS = 30
BEND = 0.1
"""Share of a step after which the residual's second derivative along it is taken."""
MOST_BEND = 0.375
"""Maximum bend of a step, as a share of its length."""
MANY = 100
"""Number of unknowns from which the shape of the minimum is computed from the normal matrix."""
BLIND = 1e-10
"""Singular values below this share of the largest contain no information in double precision."""

Residuals = Callable[[Real], tuple[Real, Real]]
"""x (P,) -> whitened residual (R,) and its Jacobian (R, P)."""


Status = Literal["converged", "slow", "rounding", "stopped"]
MESSAGES: dict[Status, str] = {
    "converged": "converged",
    "slow": "the approach to the minimum is slow, and what is left of it is negligible",
    "rounding": "double precision shows no further reduction",
    "stopped": "stopped before the minimum was reached",
}


class NotConvergedError(ArithmeticError):
    """The model cannot be evaluated where the fit starts."""


@dataclass(frozen=True)
class Prior:
    """The knowledge before the data: x ~ N(mean, inverse of root' root)."""

    mean: Real
    """(P,)"""
    root: Real
    """(H, P) W; an unknown without prior has a column of zeros."""

    @classmethod
    def independent(cls, mean: Real, sd: Real) -> Prior:
        """A prior with one standard deviation for each unknown, inf for none."""
        held = np.flatnonzero(np.isfinite(sd))
        root = np.zeros((len(held), len(sd)))
        root[np.arange(len(held)), held] = 1.0 / sd[held]
        return cls(mean, root)

    @property
    def free(self) -> int:
        """Number of unknowns without a prior."""
        return len(self.mean) - len(self.root)


@dataclass(frozen=True)
class Solution:
    """The minimum and its shape."""

    x: Real
    covariance: Real
    """(P, P) posterior covariance; blind directions without a prior have infinite variance."""
    singular_values: Real
    """(P,) singular values of the stacked Jacobian with unit columns, descending."""
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
    status: Status = "converged"
    gain_left: float = 0.0
    """Reduction of the cost that one more undamped step promises."""

    @property
    def complete(self) -> bool:
        """Whether the minimum was reached; otherwise the covariance includes the missing step."""
        return self.status != "stopped"

    @property
    def message(self) -> str:
        """How the iteration ended, in words."""
        text = MESSAGES[self.status]
        if self.complete:
            return text
        return f"{text}, after {self.steps} steps; the next would reduce the cost by {self.gain_left:.2g}"

    def ended(self, status: Status, undone: Real, length: float) -> Solution:
        """The same solution with another end: before a step `undone` (P,) of `length` standard deviations."""
        covariance = self.covariance
        if status == "stopped":
            covariance = covariance + np.outer(undone, undone)
        return replace(self, covariance=covariance, status=status, gain_left=length**2)

    @property
    def blind(self) -> int:
        """Number of directions that neither data nor prior determine."""
        return int(np.sum(self.singular_values <= BLIND * self.singular_values[0]))


def solve(residuals: Residuals, start: Real, prior: Prior, most_steps: int = MAX_STEPS) -> Solution:
    """Minimise from `start` (P,), in `most_steps` at most.

    Steps come from the normal equations with unit columns: their rounding only slows a step, since the
    residual and its gradient decide where the iteration ends. The shape of the minimum comes from the SVD of
    the stacked Jacobian itself.

    :raises NotConvergedError: the model is not a number at the start.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        return _solve(residuals, start, prior, most_steps)


def _solve(residuals: Residuals, start: Real, prior: Prior, most_steps: int) -> Solution:
    x = start.astype(float)
    stacked, target, r, J = _stack(residuals, x, prior)
    cost = float(target @ target)
    if not math.isfinite(cost):
        raise NotConvergedError("the model cannot be evaluated at the starting values")
    radius = before = math.inf
    ratio = 1.0
    extent = np.zeros(len(x))
    for step in range(1, most_steps + 2):
        gradient = stacked.T @ target
        normal: Real = stacked.T @ stacked
        full = _descend(normal, gradient)
        length = math.sqrt(max(float(full @ gradient), 0.0))
        if length < TOLERANCE:
            # the evaluation at x is unchanged there
            return _shape(x - full, stacked, r, J, cost, step)
        rate, before = length / before, length
        curved = False
        if step > SLOW_AFTER and rate > SLOW and len(x) < MANY:
            left = length / max(1.0 - rate, TOLERANCE)
            if left < NEGLIGIBLE * max(_misfit(cost, len(r)), 1.0):
                return _shape(x, stacked, r, J, cost, step).ended("slow", full, length)
            # with large residuals Gauss-Newton converges slowly: its matrix lacks their curvature
            curved = step % 2 == 1 and not ratio > GOOD
        if step > most_steps:
            break
        extent = np.maximum(extent, np.sqrt(normal.diagonal()))
        if curved:
            normal = _hessian(residuals, x, gradient, prior)
            full = _descend(normal, gradient)
        trust = _TrustRegion(normal, gradient, full, extent)
        while True:
            along, predicted = trust.step(radius)
            if along is not full and not curved and step > 1:
                _, aside, _, _ = _stack(residuals, x - BEND * along, prior)
                second = 2.0 / BEND * ((aside - target) / BEND + stacked @ along)
                along = along + trust.bend(stacked.T @ second, radius)
            new_stacked, new_target, new_r, new_J = _stack(residuals, x - along, prior)
            new_cost = float(new_target @ new_target)
            seen = ROUNDING * (1.0 + cost)
            # rounding of the cost itself must not be mistaken for an increase
            ratio = 1.0 if abs(new_cost - cost) < seen else (cost - new_cost) / predicted
            if not ratio > POOR:
                first = step == 1 and math.isinf(radius)
                radius = SHORTER * trust.size(along)
                if first:
                    # a poor first step is repeated, no longer than the start's distance from the origin
                    # (More)
                    radius = min(radius, trust.size(x) or math.inf)
                    continue
            elif ratio > GOOD and math.isfinite(radius):
                radius = max(radius, LONGER * trust.size(along))
            if ratio > 0.0:
                break
            if not predicted >= seen * TOLERANCE:
                found = _shape(x, stacked, r, J, cost, step)
                return found.ended("rounding" if length**2 < seen else "stopped", full, length)
        x, stacked, target, r, J, cost = x - along, new_stacked, new_target, new_r, new_J, new_cost
        if len(x) >= MANY and length < HUNDREDS * max(_misfit(cost, len(r)), 1.0):
            return _shape(x, stacked, r, J, cost, step)
    return _shape(x, stacked, r, J, cost, most_steps).ended("stopped", full, length)


class _TrustRegion:
    """Steps of one linearised problem that stay within a radius."""

    def __init__(self, normal: Real, gradient: Real, full: Real, extent: Real) -> None:
        self._normal, self._gradient, self._full, self._extent = normal, gradient, full, extent
        self._parts: tuple[Real, Real, Real] | None = None
        self._damping = 0.0

    def size(self, along: Real) -> float:
        """Length of a step (P,), in units of `extent`."""
        return float(np.linalg.norm(along * self._extent))

    def step(self, radius: float) -> tuple[Real, float]:
        """(P,) best step of at most `radius`, and its predicted gain."""
        if math.isinf(radius) or self.size(self._full) <= radius:
            return self._full, float(self._full @ self._gradient)
        unit = np.where(self._extent > 0.0, self._extent, 1.0)
        if self._parts is None:
            values, vectors = np.linalg.eigh(self._normal / np.outer(unit, unit))
            self._parts = (
                np.maximum(values, 0.0),
                vectors / unit[:, None],
                vectors.T @ (self._gradient / unit),
            )
        values, vectors, along = self._parts
        self._damping = _damping(values, along, radius)
        part = along / (values + self._damping)
        return vectors @ part, float(part @ along + self._damping * (part @ part))

    def bend(self, gradient: Real, radius: float) -> Real:
        """(P,) bend of the step that keeps it in its valley; zero where that would be too large.

        gradient: J' times the residual's second derivative along the step.
        """
        assert self._parts is not None
        values, vectors, _ = self._parts
        part = (vectors.T @ gradient) / (values + self._damping) / 2.0
        if not np.linalg.norm(part) < MOST_BEND * radius:
            return np.zeros(len(part))
        return np.asarray(vectors @ part)


def _damping(values: Real, along: Real, radius: float) -> float:
    """Damping that gives a step the length `radius`: Newton on its reciprocal (More and Sorensen 1983)."""
    damping = 0.0 if values[0] > 0.0 else float(np.linalg.norm(along)) / radius * TOLERANCE
    for _ in range(MOST_ROUNDS):
        part = along / (values + damping)
        size = float(np.linalg.norm(part))
        if abs(size - radius) < NEAR * radius:
            break
        slope = float(part @ (part / (values + damping)))
        damping = max(damping + (size - radius) / radius * size**2 / slope, damping / 10.0)
    return damping


def _misfit(cost: float, rows: int) -> float:
    """RMS misfit of the rows, in standard deviations."""
    return math.sqrt(cost / rows)


def _hessian(residuals: Residuals, x: Real, gradient: Real, prior: Prior) -> Real:
    """(P, P) Hessian of half the cost by differences of its gradient."""
    norms = np.linalg.norm(_stack(residuals, x, prior)[0], axis=0)
    columns = []
    for k, step in enumerate(1.0 / np.where(norms > 0.0, norms, 1.0)):
        aside = x.copy()
        aside[k] += step
        stacked, target, _, _ = _stack(residuals, aside, prior)
        columns.append((stacked.T @ target - gradient) / step)
    hessian = np.column_stack(columns)
    return np.asarray(hessian + hessian.T) / 2.0


def _descend(normal: Real, gradient: Real) -> Real:
    """Solve normal step = gradient with unit columns; the step is zero along blind directions."""
    scale = np.sqrt(normal.diagonal())
    scale[scale == 0.0] = 1.0
    unit = normal / scale
    unit /= scale[:, None]
    _, step, info = dposv(unit, gradient / scale)
    if info != 0:
        values, vectors = np.linalg.eigh(unit)
        values = np.where(values > BLIND * values[-1], values, np.inf)
        step = vectors @ ((vectors.T @ (gradient / scale)) / values)
    return np.asarray(step / scale)


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

    Hundreds of columns are computed from the normal matrix: it resolves singular values only to 1e-8 of the
    largest, but fits with so many columns have priors that keep them above that, and it saves seconds.
    """
    if stacked.shape[1] < MANY:
        _, sigma, Vt = np.linalg.svd(stacked / scale, full_matrices=False)
        return sigma, Vt
    square, vectors = np.linalg.eigh(stacked.T @ stacked / np.outer(scale, scale))
    return np.sqrt(np.maximum(square[::-1], 0.0)), vectors.T[::-1]


def _stack(residuals: Residuals, x: Real, prior: Prior) -> tuple[Real, Real, Real, Real]:
    """Rows of data above rows of prior: Jacobian (R + H, P), residual (R + H,), and the data alone."""
    r, J = residuals(x)
    if not len(prior.root):
        return J, r, r, J
    stacked, target = np.concatenate([J, prior.root]), np.concatenate([r, prior.root @ (x - prior.mean)])
    # views, so that the data's arrays are not stored twice
    return stacked, target, target[: len(r)], stacked[: len(r)]
