"""A prior for the next robot of a type: the spread of the geometry over the robots of the type.

Hierarchical: a deviation g_i of a robot is normal about the type's mean m_i with spread s_i; before any robot
is known, the normal-inverse-gamma prior of m_i and s_i is as wide as the tolerance of the robot file. The
information of a robot's readings on its geometry is its posterior divided by the prior that it started from.
The posterior is drawn by Gibbs sampling, with the conditional moments averaged (Gelman et al., Bayesian Data
Analysis, 11.6).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.five_bar import FiveBar, Robot
from station.records import FleetPrior, LastingParameters, Real, from_readings

SWEEPS, BURN_IN = 1500, 100
SHAPE = 3.0
"""Shape of the inverse gamma: that of a spread determined by six robots."""
SHARED = 0.5
"""Share of the tolerance's variance that is common to robots of a type, before any is known."""


@dataclass(frozen=True)
class Told:
    """The information of one robot's readings on its geometry."""

    information: Real
    """(G, G) of the likelihood, 1/mm^2; singular where the readings have no information."""
    score: Real
    """(G,) information times the best value."""


def fleet_prior(
    kind: str, robot: Robot, others: Sequence[tuple[Robot, LastingParameters]]
) -> FleetPrior | None:
    """Prior of a robot's geometry from the results of other robots of its type; None without others."""
    names, tolerance = geometry_of(robot)
    told = [_told(names, mate, left) for mate, left in others if set(names) <= set(left.names)]
    if not told:
        return None
    mean, covariance = _next_one(told, tolerance)
    return FleetPrior(
        type=kind,
        serials=tuple(sorted(mate.serial for mate, _ in others)),
        names=names,
        mean=_kept(mean),
        covariance=tuple(_kept(row) for row in covariance),
    )


def _kept(values: Real) -> tuple[float, ...]:
    """The prior with the digits of a stored result, so that the run can be refitted to the bit."""
    return tuple(float(f"{value:.6g}") for value in values)


def geometry_of(robot: Robot) -> tuple[tuple[str, ...], Real]:
    """Names of the geometry's unknowns, and their tolerances (G,), mm."""
    unknowns = [p for p in FiveBar(robot, from_readings([])).parameters if p.role == "geometry"]
    return tuple(p.name for p in unknowns), np.array([p.prior_sd for p in unknowns])


def _told(names: tuple[str, ...], robot: Robot, left: LastingParameters) -> Told:
    """Posterior over prior; knowledge that ageing has made wider than the prior has no information."""
    kept = [left.names.index(name) for name in names]
    mean, covariance = np.array(left.mean)[kept], np.array(left.covariance)[np.ix_(kept, kept)]
    before_mean, before = np.zeros(len(names)), np.diag(geometry_of(robot)[1] ** 2)
    if left.fleet is not None:
        before_mean, before = np.array(left.fleet.mean), np.array(left.fleet.covariance)
    unit = np.linalg.inv(np.linalg.cholesky(before))
    inner = np.linalg.inv(unit @ covariance @ unit.T)
    values, vectors = np.linalg.eigh(inner - np.eye(len(names)))
    said = vectors[:, values > 0.0]
    score = said.T @ (inner @ unit @ mean - unit @ before_mean)
    back = unit.T @ said
    return Told(back @ np.diag(values[values > 0.0]) @ back.T, back @ score)


def _next_one(told: Sequence[Told], tolerance: Real) -> tuple[Real, Real]:
    """Mean (G,) and covariance (G, G) of the next robot's geometry; in units of its tolerances inside."""
    scale = np.outer(tolerance, tolerance)
    information = np.array([one.information * scale for one in told])
    score = np.array([one.score * tolerance for one in told])
    count, size = score.shape
    rng = np.random.default_rng(0)
    mean, square = np.zeros(size), np.full(size, 1.0 - SHARED)
    strength = (1.0 - SHARED) / SHARED
    sure = strength + count
    shape = SHAPE + count / 2.0
    means, squares, spreads = [], [], []
    for sweep in range(SWEEPS):
        root = np.linalg.cholesky(information + np.diag(1.0 / square))
        turned = np.swapaxes(root, 1, 2)
        told_to = np.linalg.solve(root, (score + mean / square)[:, :, None])
        each = np.linalg.solve(turned, told_to + rng.standard_normal((count, size, 1)))[:, :, 0]
        average = each.mean(axis=0)
        centre = count * average / sure
        scatter = (1.0 - SHARED) * (SHAPE - 1.0) + 0.5 * (
            ((each - average) ** 2).sum(axis=0) + strength * count / sure * average**2
        )
        square = scatter / rng.gamma(shape, size=size)
        mean = centre + np.sqrt(square / sure) * rng.standard_normal(size)
        if sweep >= BURN_IN:
            means.append(centre)
            squares.append(scatter / (shape - 1.0))
            spreads.append(scatter / (shape - 1.0) / sure)
    covariance = np.cov(np.array(means).T) + np.diag(np.mean(squares, axis=0) + np.mean(spreads, axis=0))
    return np.mean(means, axis=0) * tolerance, covariance * scale
