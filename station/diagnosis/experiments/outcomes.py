"""The readings that each explanation predicts for an experiment, and how often it decides between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

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

    @cached_property
    def lower(self) -> Real:
        """(N, N) Cholesky factor of the covariance."""
        return np.linalg.cholesky(self.covariance)

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
    done = 0
    for truth, draws in enumerate(rng.multinomial(DRAWS, prior)):
        if not draws:
            continue
        expected = outcomes[truth]
        noise = rng.standard_normal((len(expected.mean), draws))
        read = expected.mean[:, None] + expected.lower @ noise
        done += int(np.sum(probabilities(outcomes, prior, read).max(axis=0) >= SURE))
    return done / DRAWS


def probabilities(outcomes: Sequence[Outcome], prior: Sequence[float] | Real, read: Real) -> Real:
    """(H, D) of each explanation, after the experiment gave readings (N, D) in each of D repetitions."""
    log = np.empty((len(outcomes), read.shape[1]))
    for k, o in enumerate(outcomes):
        z = solve_triangular(o.lower, read - o.mean[:, None], lower=True)
        log[k] = np.log(prior[k]) - 0.5 * np.sum(z**2, axis=0) - np.sum(np.log(np.diag(o.lower)))
    return np.asarray(np.exp(log - logsumexp(log, axis=0)))
