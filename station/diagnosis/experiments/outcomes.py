"""The readings that each explanation predicts for an experiment, and how often it decides between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_triangular
from scipy.special import logsumexp

from station.diagnosis.explanations import root_of
from station.records import Real

SURE = 0.95
DRAWS = 300


@dataclass(frozen=True)
class Outcome:
    """Readings not yet taken, as one explanation predicts them."""

    mean: Real
    """(N,)"""
    root: Real
    """(N, X) root of the covariance of what the explanation leaves uncertain."""
    noise: Real
    """(N,) variance of a reading."""

    @property
    def covariance(self) -> Real:
        """(N, N) of the readings."""
        return np.asarray(self.root @ self.root.T + np.diag(self.noise))

    @classmethod
    def linear(cls, mean: Real, jacobian: Real, covariance: Real, noise_sd: Real | float) -> Outcome:
        """An outcome from derivatives (N, X) by unknowns with this covariance (X, X)."""
        noise = np.broadcast_to(np.asarray(noise_sd) ** 2, mean.shape)
        return cls(mean, jacobian @ root_of(covariance), noise)

    def beside(self, column: Real) -> Outcome:
        """The same with one more unknown of unit variance, which adds this (N,)."""
        return replace(self, root=np.column_stack([self.root, column]))

    def take(self, rows: Sequence[int]) -> Outcome:
        """A selection of the readings; one that is taken twice has separate noise each time."""
        return Outcome(self.mean[list(rows)], self.root[list(rows)], self.noise[list(rows)])


def decides(outcomes: Sequence[Outcome], probability: Sequence[float], seed: int = 0) -> float:
    """The probability that one explanation has a probability of 0.95 afterwards.

    An explanation is drawn by its probability, then readings under it; then all explanations are weighed
    again.
    """
    rng = np.random.default_rng(seed)
    prior = np.array(probability) / np.sum(probability)
    count = rng.multinomial(DRAWS, prior)
    roots = [np.linalg.cholesky(o.covariance) for o in outcomes]
    logs = [float(2.0 * np.sum(np.log(np.diag(root)))) for root in roots]
    done = 0
    for truth, draws in enumerate(count):
        if not draws:
            continue
        noise = rng.standard_normal((len(outcomes[truth].mean), draws))
        read = outcomes[truth].mean[:, None] + roots[truth] @ noise
        posterior = np.empty((len(outcomes), draws))
        for k, (o, root, log) in enumerate(zip(outcomes, roots, logs, strict=True)):
            z = solve_triangular(root, read - o.mean[:, None], lower=True)
            posterior[k] = np.log(prior[k]) - 0.5 * (np.sum(z**2, axis=0) + log)
        top = np.exp(posterior.max(axis=0) - logsumexp(posterior, axis=0))
        done += int(np.sum(top >= SURE))
    return done / DRAWS
