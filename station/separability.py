"""Which parameters the readings cannot tell apart, by name, and what ties them.

Each unknown is counted in its own tolerance: a direction in which the readings say less than the tolerances
do is not measured at all, it is tied by them.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from station.kinematics import Real
from station.least_squares import Solution
from station.mechanism import Mechanism

TIED = 1.0
"""Information of the readings over that of the tolerances below which the tolerances decide."""
NAMED = 0.25
"""Share of a direction from which a parameter is named in it."""
MOST_NAMED = 4


def describe(mechanism: Mechanism, solution: Solution, sd_factor: float) -> dict[str, Any]:
    """{singular_ratio, text, sd_deg, blind, remedies}: the contract's `weak_direction`.

    sd_deg is the largest standard uncertainty of a zero offset; `blind` are the directions that tolerances tie.
    """
    size = len(mechanism.parameters)
    sigma, directions = separable(mechanism, solution)
    names = [p.name for p in mechanism.parameters]
    tied = [in_words(names, row) for s, row in zip(sigma, directions, strict=True) if s < TIED]
    zero_sd = np.sqrt(np.diag(solution.covariance)[: mechanism.theta.shape[1]]) * sd_factor
    return {
        "singular_ratio": float(sigma[-1] / sigma[0]),
        "text": f"{in_words(names, directions[-1])}; {len(tied)} of {size} directions are held by tolerances alone",
        "sd_deg": float(np.degrees(zero_sd.max())),
        "blind": tied,
        "remedies": [],
    }


def separable(mechanism: Mechanism, solution: Solution) -> tuple[Real, Real]:
    """Singular values (P,) of the whitened Jacobian per tolerance, descending, and their directions (P, P).

    An unknown without a tolerance is counted in what the readings alone know of it.
    """
    J = solution.jacobian[:, : len(mechanism.parameters)]
    tolerance = np.array([p.prior_sd for p in mechanism.parameters])
    alone = 1.0 / np.maximum(np.linalg.norm(J, axis=0), 1e-300)
    scale = np.where(np.isfinite(tolerance), tolerance, alone * 1e6)
    scaled = np.linalg.qr(J * scale, mode="r")
    _, sigma, directions = np.linalg.svd(scaled)
    return sigma, directions


def in_words(names: list[str], direction: Real) -> str:
    """The parameters that make up most of a direction, largest first, each with its sign."""
    order = np.argsort(-np.abs(direction))[:MOST_NAMED]
    kept = [k for k in order if abs(direction[k]) >= NAMED * abs(direction[order[0]])]
    sign = np.sign(direction[kept[0]])
    return " ".join(f"{'+' if direction[k] * sign > 0 else '-'}{names[k]}" for k in kept)
