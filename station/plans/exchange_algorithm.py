"""Selection of measurement positions: greedy start and exchange on the mean predicted position variance.

The criterion is trace(C M): C the posterior covariance of all parameters, M the mean over the workspace of
J_r' J_r, so it is the mean square position error after the calibration.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.records import Complex, Flags, Real

MAX_ROUNDS = 20
STARTS = 12
"""Random starts beside the greedy one: the exchange ends in local optima."""


def choose(
    rows: Real, places: Complex, information: Real, weight: Real, count: int, apart_mm: float
) -> list[int]:
    """Indices of `count` candidates with the smallest position error, from several starts.

    rows (N, P) whitened Jacobian of each candidate reading, positions (N,) of the readings, information (P,
    P) of the prior (non-singular), weight (P, P) M; positions are at least `apart_mm` from each other.

    :raises ValueError: there are fewer candidates at that distance than requested.
    """
    problem = _Problem(rows, information, weight, np.abs(places[:, None] - places[None, :]) < apart_mm)
    rng = np.random.default_rng(0)
    starts = [problem.greedy(count)] + [problem.scattered(count, rng) for _ in range(STARTS)]
    complete = [problem.exchange(start) for start in starts if len(start) == count]
    if not complete:
        raise ValueError(f"{count} places {apart_mm} mm apart were not found")
    return min(complete, key=problem.criterion)


@dataclass(frozen=True)
class _Problem:
    rows: Real
    information: Real
    weight: Real
    near: Flags
    """(N, N) pairs too close to be chosen together."""

    def criterion(self, chosen: list[int]) -> float:
        return float(np.trace(self._covariance(chosen) @ self.weight))

    # a start without enough candidates left ends short and is skipped

    def greedy(self, count: int) -> list[int]:
        chosen: list[int] = []
        while len(chosen) < count and self._allowed(chosen).any():
            chosen.append(self._best(chosen))
        return chosen

    def scattered(self, count: int, rng: np.random.Generator) -> list[int]:
        chosen: list[int] = []
        while len(chosen) < count and self._allowed(chosen).any():
            chosen.append(int(rng.choice(np.flatnonzero(self._allowed(chosen)))))
        return chosen

    def exchange(self, start: list[int]) -> list[int]:
        """Replace one position after the other by the best for its slot until none changes."""
        chosen = list(start)
        for _ in range(MAX_ROUNDS):
            before = list(chosen)
            for slot in range(len(chosen)):
                chosen[slot] = self._best(chosen[:slot] + chosen[slot + 1 :])
            if chosen == before:
                break
        return chosen

    def _covariance(self, chosen: list[int]) -> Real:
        return np.asarray(np.linalg.inv(self.information + self.rows[chosen].T @ self.rows[chosen]))

    def _best(self, chosen: list[int]) -> int:
        """The further candidate whose reading lowers trace(C M) most (rank-one update)."""
        covariance = self._covariance(chosen)
        spread = self.rows @ covariance
        gain = np.einsum("ni,ni->n", spread @ self.weight, spread)
        gain /= 1.0 + np.einsum("ni,ni->n", spread, self.rows)
        return int(np.argmax(np.where(self._allowed(chosen), gain, -np.inf)))

    def _allowed(self, chosen: list[int]) -> Flags:
        return np.asarray(~self.near[chosen].any(axis=0))
