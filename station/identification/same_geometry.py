"""The difference of one machine's zeros between two fits with the same geometry.

Most of the uncertainty of a zero offset comes from the geometry, which is the same in both. Given the
geometry g, a fit gives dtheta = dtheta^ + S (g - g^) with S the regression of the zeros on it and V the
remaining covariance; both fits are evaluated at the geometry of the later one.
"""

from __future__ import annotations

import numpy as np

from station.five_bar import FiveBar
from station.identification.estimate import Identification
from station.records import Real


def zero_difference(
    earlier: Identification[FiveBar], later: Identification[FiveBar], *, same_mounting: bool
) -> tuple[Real, Real]:
    """Earlier less later zero offsets (2,), rad, and their covariance (2, 2).

    :param same_mounting: the mechanism was not remounted between them, so its mounting error is the same
    """
    roles = ("geometry", "mechanism") if same_mounting else ("geometry",)
    known = {p.name for p in later.mechanism.parameters}
    names = [p.name for p in earlier.mechanism.parameters if p.role in roles and p.name in known]
    then, there = (_places(fit, names) for fit in (earlier, later))
    by_then, left_then = _given(earlier, then)
    by_now, left_now = _given(later, there)
    geometry = later.covariance[np.ix_(there, there)]
    apart = by_then - by_now
    difference = earlier.dtheta + by_then @ (later.p[there] - earlier.p[then]) - later.dtheta
    return difference, np.asarray(left_then + left_now + apart @ geometry @ apart.T)


def _places(fit: Identification[FiveBar], names: list[str]) -> list[int]:
    order = [p.name for p in fit.mechanism.parameters]
    return [order.index(name) for name in names]


def _given(fit: Identification[FiveBar], kept: list[int]) -> tuple[Real, Real]:
    """(2, M) regression of the zeros on the common parameters, and (2, 2) the remaining covariance."""
    C = fit.covariance
    by_kept = np.linalg.solve(C[np.ix_(kept, kept)], C[kept, :2]).T
    return by_kept, C[:2, :2] - by_kept @ C[kept, :2]
