"""The fastest small set of positions that is accurate enough and could contradict a wrong memory.

A search that adds one position at a time cannot find it: the first three readings only determine two zero
offsets and the offset of the readout, and any three do.
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
SHORT_S = 60.0
"""Penalty in seconds for each factor e by which a set falls short of the requirement."""
LEAST_POWER = 1e-3


@dataclass(frozen=True)
class Quickest:
    """The candidates and the requirement."""

    covariance: Real
    """(P, P) of all unknowns before any reading."""
    rows: Real
    """(N, P) whitened derivatives of one reading at each candidate."""
    weight: Real
    """(P, P) M: trace(C M) is the mean square position error, apart from `stays`."""
    stays: float
    """Part of the mean square position error that no reading changes, mm^2."""
    enough: float
    """Required mean square position error in total, mm^2."""
    theta_deg: Real
    """(N, 2) commands."""
    here_deg: Real
    """(2,)"""
    pace: Pace
    test: Contradiction | None
    """Test of the memory; None without one."""
    changes: Real
    """(D, M) changes of the remembered parameters that must be detected."""
    power: float
    """Required mean probability."""

    def choose(self, fewest: int, most: int) -> list[int]:
        """The smallest sufficient set of candidates, in the order of the fastest path.

        Where even `most` are not sufficient, the candidates with the best benefit per time are chosen.
        """
        found: list[list[int]] = []
        for count in range(fewest, most + 1):
            found.append(self._exchanged(count))
            if self._short(np.array([found[-1]]))[0] == 0.0:
                return found[-1]
        return min(found, key=lambda chosen: float(self._cost(np.array([chosen]))[0]))

    def _exchanged(self, count: int) -> list[int]:
        """The best of several starts, with one position after the other replaced by the best for its slot."""
        rng = np.random.default_rng(0)
        starts = [rng.choice(len(self.rows), count, replace=False) for _ in range(STARTS)]
        best = min((self._improved(start) for start in starts), key=lambda found: found[0])[1]
        return [int(k) for k in best[self._way(best[None])[1][0]]]

    def _improved(self, chosen: Index) -> tuple[float, Index]:
        cost = float(self._cost(chosen[None])[0])
        for _ in range(ROUNDS):
            before = cost
            for slot in range(len(chosen)):
                others = np.tile(chosen, (len(self.rows), 1))
                others[:, slot] = np.arange(len(self.rows))
                others = others[~np.isin(others[:, slot], np.delete(chosen, slot))]
                costs = self._cost(others)
                if costs.min() < cost:
                    chosen, cost = others[np.argmin(costs)], float(costs.min())
            if cost == before:
                break
        return cost, chosen

    def _cost(self, sets: Index) -> Real:
        """(S,) cost of sets (S, count)."""
        return self._way(sets)[0] + SHORT_S * self._short(sets)

    def _short(self, sets: Index) -> Real:
        """(S,) factors e that accuracy and power together lack; 0 if they are sufficient."""
        rows = self.rows[sets]
        turned = np.swapaxes(rows, 1, 2)
        spread = rows @ self.covariance
        told = np.eye(sets.shape[1]) + spread @ turned
        left = self._before - np.sum(np.linalg.solve(told, spread) * (spread @ self.weight), axis=(1, 2))
        short = np.maximum(0.0, np.log(np.maximum(left, 1e-12) / self.enough))
        if self.test is not None and len(self.changes):
            information = turned @ rows
            found = self.test.power(
                self.test.noncentrality(information, self.changes), self.test.directions(information)
            )
            missed = np.maximum(1.0 - found.mean(axis=1), LEAST_POWER)
            short += np.maximum(0.0, np.log(missed / (1.0 - self.power)))
        return np.asarray(short)

    @cached_property
    def _before(self) -> float:
        return self.stays + float(np.trace(self.covariance @ self.weight))

    @cached_property
    def _legs(self) -> Real:
        """(N + 1, N) seconds to each candidate, from here and from each candidate."""
        start = np.vstack([self.here_deg, self.theta_deg])[:, None]
        there = np.broadcast_to(self.theta_deg[None], (len(start), *self.theta_deg.shape))
        return self.pace.duration_s(start, there, np.zeros_like(there))

    def _way(self, sets: Index) -> tuple[Real, Index]:
        """(S,) seconds of the fastest path through each set (S, count), and (S, count) its order."""
        orders = _orders(sets.shape[1])
        way = sets[:, orders]
        duration_s = self._legs[0, way[..., 0]] + self._legs[1 + way[..., :-1], way[..., 1:]].sum(axis=2)
        best = np.argmin(duration_s, axis=1)
        return duration_s[np.arange(len(sets)), best], orders[best]


@cache
def _orders(count: int) -> Index:
    """(count!, count) all orders of a few positions."""
    return np.array(list(permutations(range(count))))
