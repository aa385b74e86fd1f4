"""Unnamed alternatives to a cause: the residual varies with time, position, angle or travel.

Each alternative is a Gaussian process added to the noise (Rasmussen and Williams, Gaussian Processes for
Machine Learning, 2006, chapter 5), its size found by restricted maximum likelihood (Patterson and Thompson,
Biometrika 58, 1971). A cause with its few parameters must make the readings far more probable than any of
them: a flexible function imitates a random variation, three ripples a bump.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from station.diagnosis.tests_of_fit.smooth_departures import (
    WhitenedResidual,
    by_approach_and_place,
    perpendicular,
)
from station.mechanism import Conditions
from station.model import Term
from station.records import Real

REACH = 0.1
"""Correlation length, as a share of the visited range."""
FAR_BETTER = 10.0
"""Minus twice the log likelihood: 150 times more probable ("very strong", Kass and Raftery 1995)."""
SIZES = np.geomspace(1e-3, 1e6, 40)
"""Variance of the alternative over that of the noise."""


@dataclass(frozen=True)
class Alternative:
    """One kind of variation, with the size that fits the readings best."""

    on: str
    score: float
    """Minus twice the log restricted likelihood, plus the price of its size."""
    share: float
    """Share of the residual's sum of squares that it takes, 0 to 1."""


def alternatives(residual: WhitenedResidual) -> tuple[Alternative, ...]:
    """All kinds, in place of all effects; `residual` is that of the model without them."""
    return tuple(_fitted(residual, on, covariance) for on, covariance in _kinds(residual))


def strongest(
    without: WhitenedResidual, explained: WhitenedResidual, terms: Sequence[Term], conditions: Conditions
) -> str | None:
    """The alternative that the terms do not beat by `FAR_BETTER`, None where they beat all.

    Terms are charged for their amplitudes (BIC: Schwarz, Annals of Statistics 6, 1978) and for their search.
    """
    price = 0.0
    for term in terms:
        variants = term.effect.variants(conditions)
        price += term.size * np.log(without.dof) + (2.0 * np.log(variants.trials) if variants else 0.0)
    ours = without.dof * float(np.log(explained.square)) + price
    best = min(alternatives(without), key=lambda r: r.score)
    return best.on if best.score - ours < FAR_BETTER else None


def _kinds(residual: WhitenedResidual) -> Iterator[tuple[str, Real]]:
    """(K, K) covariance in mm^2, of any size."""
    order = np.argsort(np.argsort(residual.of("t_s"), kind="stable"), kind="stable") + 1.0
    # Brownian: every stop adds to the previous one
    yield "time", np.minimum(order[:, None], order[None, :]) / len(order)
    if np.any(residual.of("approach") != 0):
        columns = by_approach_and_place(residual)
        yield "approach x place", columns @ columns.T
    yield "place", _alike(residual.at, float(np.ptp(residual.at[:, 0])))
    for i, theta in enumerate(residual.of("theta").T):
        yield f"theta{i + 1}", _alike(theta[:, None], float(np.ptp(theta)))
    travel = residual.of("travel")
    if np.ptp(travel) > 0.0:
        yield "travel", _alike(travel[:, None], float(np.ptp(travel)))


def _alike(along: Real, span: float) -> Real:
    """(K, K) squared exponential of the distance between rows of along (K, d)."""
    apart = np.linalg.norm(along[:, None] - along[None, :], axis=2) / (REACH * span or 1.0)
    return np.asarray(np.exp(-0.5 * apart**2))


def _fitted(residual: WhitenedResidual, on: str, covariance: Real) -> Alternative:
    sd = residual.row_sd
    whitened = np.zeros((len(residual.left), len(residual.left)))
    own = covariance[np.ix_(residual.reading, residual.reading)] * (residual.axis[:, None] == residual.axis)
    whitened[: len(sd), : len(sd)] = own * np.mean(sd**2) / np.outer(sd, sd)
    inside = perpendicular(perpendicular(whitened, residual.taken).T, residual.taken)
    values, vectors = np.linalg.eigh((inside + inside.T) / 2.0)
    stretch = 1.0 + SIZES[:, None] * np.maximum(values, 0.0)
    along = (vectors.T @ residual.left) ** 2
    left = np.sum(along / stretch, axis=1)
    scores = residual.dof * np.log(left) + np.sum(np.log(stretch), axis=1)
    best = int(np.argmin(scores))
    share = 1.0 - float(np.sum(along / stretch[best] ** 2)) / residual.square
    return Alternative(on, float(scores[best]) + float(np.log(residual.dof)), share)
