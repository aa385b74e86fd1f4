"""Smooth departures from any model: in time, by approach and place, by place, along an angle or the travel.

The catalogue names causes; these name nothing, and are what a cause has to beat.  A residual is
held against a few smooth columns of each kind with whatever the model could still take up
projected out (an added-variable F test; Cook and Weisberg, Residuals and Influence in Regression,
1982, section 2.3.2).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.model import Fit, Model
from station.effects import Conditions
from station.kinematics import Complex, Real


@dataclass(frozen=True)
class Rest:
    """What a model leaves of readings, whitened, and what it could still take up."""

    residual: Real
    """(N,) readings, then prior rows; perpendicular to `taken`."""
    taken: Real
    """(N, P) orthonormal."""
    dof: int
    conditions: Conditions
    at: Complex
    row_sd: Real
    """(K,) mm"""

    def reduction(self, columns: Real) -> tuple[float, int]:
        """Of the square by columns (K, q) in mm, and how many of them count."""
        spread = np.zeros((len(self.residual), columns.shape[1]))
        spread[: len(self.row_sd)] = columns / self.row_sd[:, None]
        norm = np.linalg.norm(spread, axis=0)
        spread /= np.where(norm > 0, norm, 1.0)
        left = spread - self.taken @ (self.taken.T @ spread)
        u, s, _ = np.linalg.svd(left, full_matrices=False)
        along = u[:, s > 1e-3].T @ self.residual
        return float(along @ along), len(along)

    def p_value(self, columns: Real) -> float:
        won, size = self.reduction(columns)
        dof = self.dof - size
        rest = float(self.residual @ self.residual) - won
        if dof <= 0 or size == 0:
            return 1.0
        return float(fdtrc(size, dof, (won / size) / (max(rest, 1e-12) / dof)))


def cosines(along: Real, count: int) -> Real:
    """(K, count) half waves over the order of the readings along something."""
    rank = np.argsort(np.argsort(along, kind="stable"), kind="stable")
    s = (rank + 0.5) / len(along)
    return np.cos(np.pi * s[:, None] * np.arange(1, count + 1))


def unit(v: Real) -> Real:
    low, high = float(v.min()), float(v.max())
    return (v - low) / ((high - low) or 1.0)


def by_approach(c: Conditions, at: Complex) -> Real:
    x, y = 2.0 * unit(at.real) - 1.0, 2.0 * unit(at.imag) - 1.0
    smooth = np.stack([np.ones(len(x)), x, y, x * x, x * y, y * y], axis=1)
    senses = np.column_stack([c.slider_direction, c.slider_net, c.approach])
    return (senses[:, :, None] * smooth[:, None, :]).reshape(len(x), -1)


def by_place(at: Complex) -> Real:
    x, y = unit(at.real), unit(at.imag)
    return np.stack(
        [np.cos(np.pi * i * x) * np.cos(np.pi * j * y) for i in range(6) for j in range(3) if i + j], axis=1
    )


def kinds(rest: Rest) -> Iterator[tuple[str, Real]]:
    c = rest.conditions
    yield "time", cosines(c.t_s, 6)
    yield "approach x place", by_approach(c, rest.at)
    yield "place", by_place(rest.at)
    for i in range(c.theta.shape[1]):
        yield f"theta{i + 1}", cosines(c.theta[:, i], 8)
    yield "travel", cosines(c.travel, 8)


def pooled(learned: Fit, model: Model, residual: Real, J: Real, sd: Real, fresh: Conditions) -> Rest:
    """Of readings learned on and fresh ones together; hidden parameters stay as learned."""
    s = learned.solution
    stacked = np.concatenate([s.jacobian, J / sd[:, None], learned.prior.root])
    pull = learned.prior.root @ (learned.prior.mean - learned.x)
    z = np.concatenate([-s.residual, residual / sd, pull])
    norms = np.linalg.norm(stacked, axis=0)
    q = np.linalg.qr(stacked / np.where(norms > 0, norms, 1.0))[0]
    a, base = learned.model, learned.x[: learned.model.base_size]
    at = np.concatenate([a.mechanism.positions(base), model.mechanism.positions(base)])
    both = {}
    for name in ("t_s", "theta", "drive_angle", "approach", "travel", "slider_direction", "slider_net", "pull"):
        both[name] = np.concatenate([getattr(learned.conditions, name), getattr(fresh, name)])
    c = Conditions(**both, temperature_rise=None, payload_kg=None, lengths={})
    n = len(learned.row_sd) + len(sd)
    return Rest(z - q @ (q.T @ z), q, n - learned.prior.free, c, at, np.concatenate([learned.row_sd, sd]))
