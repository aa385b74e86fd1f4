"""The explanations that an experiment has to decide between."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis.explanations import ExplanationSet, Settled
from station.five_bar import FiveBar

LEAST, MOST = 0.01, 8
FLAT_SD_MM = 1e3
"""Prior standard deviation of a reading offset about which nothing is known."""


@dataclass(frozen=True)
class Hypothesis:
    """One explanation with its posterior."""

    settled: Settled
    probability: float

    def of(self, mechanism: FiveBar, learned: FiveBar) -> Hypothesis:
        """The same for a mechanism with further parameters, for which only the prior is known."""
        names = [p.name for p in learned.parameters]
        old, q = self.settled, len(self.settled.x) - self.settled.size
        mean = mechanism.start
        sd = np.array([min(p.prior_sd, FLAT_SD_MM) for p in mechanism.parameters])
        size = len(mean)
        x = np.concatenate([mean, old.x[old.size :]])
        covariance = np.diag(np.concatenate([sd**2, np.zeros(q)]))
        where = [names.index(p.name) if p.name in names else -1 for p in mechanism.parameters]
        new = np.array([k for k, at in enumerate(where) if at >= 0] + list(range(size, size + q)))
        from_ = np.array([at for at in where if at >= 0] + list(range(old.size, old.size + q)))
        x[new] = old.x[from_]
        covariance[np.ix_(new, new)] = old.covariance[np.ix_(from_, from_)]
        return Hypothesis(replace(old, x=x, covariance=covariance), self.probability)


def hypotheses(found: ExplanationSet, least: float = LEAST) -> tuple[Hypothesis, ...]:
    """Most probable first; probabilities sum to one."""
    cores = [(key, p) for key, p in found.statements.cores[:MOST] if p >= least]
    total = sum(p for _, p in cores)
    return tuple(Hypothesis(found.weighing.settle(key), p / total) for key, p in cores)
