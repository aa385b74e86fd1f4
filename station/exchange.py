"""Choosing measurement places: greedy start and exchange on the mean predicted position variance.

The criterion is trace(C M): C the posterior covariance of all parameters, M the mean over the
workspace of J_r' J_r, so it is the mean square position error that the calibration leaves behind.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from station.kinematics import Complex, Real

MAX_ROUNDS = 20


def choose(
    rows: Real, places: Complex, information: Real, weight: Real, count: int, apart_mm: float
) -> list[int]:
    """Indices of `count` candidates that serve the position error best.

    rows (N, P) whitened Jacobian of each candidate reading, places (N,) where it is, information
    (P, P) what is known beforehand (non-singular), weight (P, P) M; places are kept `apart_mm` from
    each other.

    :raises ValueError: fewer candidates that far apart than asked for.
    """
    chosen: list[int] = []
    allowed = _Allowed(places, apart_mm)
    covariance = np.linalg.inv(information)
    for _ in range(count):
        best = _best(rows, covariance, weight, allowed.mask(chosen))
        chosen.append(best)
        covariance = _add(covariance, rows[best])
    for _ in range(MAX_ROUNDS):
        before = list(chosen)
        for slot in range(count):
            others = chosen[:slot] + chosen[slot + 1 :]
            reduced = np.linalg.inv(information + rows[others].T @ rows[others])
            chosen[slot] = _best(rows, reduced, weight, allowed.mask(others))
        if chosen == before:
            break
    return chosen


class _Allowed:
    """Which candidates stay far enough from those chosen."""

    def __init__(self, places: Complex, apart_mm: float) -> None:
        self._near = np.abs(places[:, None] - places[None, :]) < apart_mm

    def mask(self, chosen: list[int]) -> NDArray[np.bool_]:
        return np.asarray(~self._near[chosen].any(axis=0))


def _best(rows: Real, covariance: Real, weight: Real, allowed: NDArray[np.bool_]) -> int:
    """The candidate whose reading lowers trace(C M) most (rank-one update)."""
    if not allowed.any():
        raise ValueError("not that many places are that far apart")
    spread = rows @ covariance
    gain = np.einsum("ni,ij,nj->n", spread, weight, spread) / (1.0 + np.einsum("ni,ni->n", spread, rows))
    return int(np.argmax(np.where(allowed, gain, -np.inf)))


def _add(covariance: Real, row: Real) -> Real:
    spread = covariance @ row
    return np.asarray(covariance - np.outer(spread, spread) / (1.0 + row @ spread))
