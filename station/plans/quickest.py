"""The quickest few positions that are accurate enough together and could contradict a wrong memory.

One position at a time cannot find them: the first three readings only settle two zero offsets and the offset
of the readout, and any three do.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from itertools import permutations

import numpy as np

from station.plans.duration import Pace
from station.plans.next_position import Contradiction
from station.records import Index, Real

STARTS = 3
ROUNDS = 4
SHORT_S = 20.0
"""Seconds that a set is made worse by for each factor e that it falls short of what is needed."""
LEAST_POWER = 1e-3


@dataclass(frozen=True)
class Quickest:
    """What to choose from, and what is needed."""

    covariance: Real
    """(P, P) of all unknowns before any reading."""
    rows: Real
    """(N, P) whitened derivatives of one reading at each candidate."""
    weight: Real
    """(P, P) M: trace(C M) is the mean square position error."""
    enough: float
    """Of trace(C M), mm^2."""
    theta_deg: Real
    """(N, 2) commands."""
    here_deg: Real
    """(2,)"""
    pace: Pace
    test: Contradiction | None
    """Of the memory; None where there is none."""
    changes: Real
    """(D, M) of what is remembered, that must be noticed."""
    power: float
    """Mean probability that is asked for."""

    def choose(self, fewest: int, most: int) -> list[int]:
        """As few candidates as do, in the order of the quickest way; the best of `most` where none do."""
        best: list[int] = []
        for count in range(fewest, most + 1):
            best = self._exchanged(count)
            if self._short(best) == 0.0:
                break
        return best

    def _exchanged(self, count: int) -> list[int]:
        """Of several starts, one position after the other replaced by the best for its place in the set."""
        rng = np.random.default_rng(0)
        found = [
            self._improved(list(rng.choice(len(self.rows), count, replace=False))) for _ in range(STARTS)
        ]
        best = min(found, key=self._cost)
        return [best[k] for k in self._way(best)[1]]

    def _improved(self, chosen: list[int]) -> list[int]:
        cost = self._cost(chosen)
        for _ in range(ROUNDS):
            before = cost
            for slot in range(len(chosen)):
                for candidate in range(len(self.rows)):
                    if candidate in chosen:
                        continue
                    other = [*chosen[:slot], candidate, *chosen[slot + 1 :]]
                    if (its := self._cost(other)) < cost:
                        chosen, cost = other, its
            if cost == before:
                break
        return chosen

    def _cost(self, chosen: list[int]) -> float:
        return self._way(chosen)[0] + SHORT_S * self._short(chosen)

    def _short(self, chosen: list[int]) -> float:
        """Factors e that accuracy and power together lack; 0 when nothing does."""
        rows = self.rows[chosen]
        spread = rows @ self.covariance
        told = np.eye(len(rows)) + spread @ rows.T
        left = self._before - float(np.sum(np.linalg.solve(told, spread) * (spread @ self.weight)))
        short = max(0.0, float(np.log(max(left, 1e-12) / self.enough)))
        if self.test is not None:
            information = rows.T @ rows
            found = self.test.power(
                self.test.noncentrality(information, self.changes), self.test.directions(information)
            )
            missed = 1.0 - float(found.mean()) if len(found) else 0.0
            short += max(0.0, float(np.log(max(missed, LEAST_POWER) / (1.0 - self.power))))
        return short

    @cached_property
    def _before(self) -> float:
        return float(np.trace(self.covariance @ self.weight))

    @cached_property
    def _legs(self) -> Real:
        """(N + 1, N) seconds from here, and from each candidate, to each."""
        start = np.vstack([self.here_deg, self.theta_deg])[:, None]
        there = np.broadcast_to(self.theta_deg[None], (len(start), *self.theta_deg.shape))
        return self.pace.duration_s(start, there, np.zeros_like(there))

    def _way(self, chosen: list[int]) -> tuple[float, tuple[int, ...]]:
        """Seconds of the quickest way, and its order."""
        orders = _orders(len(chosen))
        way = np.array(chosen)[orders]
        legs = self._legs
        duration_s = legs[0, way[:, 0]] + legs[1 + way[:, :-1], way[:, 1:]].sum(axis=1)
        best = int(np.argmin(duration_s))
        return float(duration_s[best]), tuple(int(k) for k in orders[best])


@cache
def _orders(count: int) -> Index:
    """(count!, count) of a few."""
    return np.array(list(permutations(range(count))))
