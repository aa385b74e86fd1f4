"""Position error from a mean error field and a covariance; the uncertainty of the common mode."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import ndtri

from station.records import PositionError, Real


def position_error_summary(mean: Real, jacobian: Real, covariance: Real) -> PositionError:
    """RMS of the position error field over the grid, and its largest value."""
    return rms_and_max(position_error_field(mean, jacobian, covariance))


def rms_and_max(error_mm: Real) -> PositionError:
    """RMS and maximum of position errors (G,), mm."""
    return PositionError(rms=float(np.sqrt(np.mean(error_mm**2))), max=float(error_mm.max()))


def position_error_field(mean: Real, jacobian: Real, covariance: Real) -> Real:
    """(G,) sqrt(|mean|^2 + trace(J C J')) at each position of a grid, mm."""
    finite = np.isfinite(np.diag(covariance))
    J, C = jacobian[:, :, finite], covariance[np.ix_(finite, finite)]
    # as one flat product, and in place: for a long log the arrays are large
    variance = (J.reshape(-1, len(C)) @ C).reshape(J.shape)
    variance *= J
    variance = variance.sum(axis=(1, 2))
    return np.asarray(np.sqrt(np.sum(mean**2, axis=1) + variance))


DRAWS = 2000
"""With this number of draws the bound has a standard error of 0.4 %."""
BLOCK = 8
"""Number of positions computed at once."""


@dataclass(frozen=True)
class ErrorFields:
    """Position errors at positions (G,), mm."""

    before: Real
    """(G,) expected with the previous zeros of the drives: the root of the mean square."""
    after: Real
    """(G,) expected with the identified zeros in the drives."""
    after_95: Real
    """(G,) 95 % bound at each position separately."""

    def within(self, bound: float) -> Real:
        """(G,) bounds in proportion to those of each position; the largest equals the bound on all."""
        return np.asarray(self.after_95 * (bound / np.nanmax(self.after_95)))


def largest_error_bound(mean: Real, jacobian: Real, covariance: Real) -> float:
    """Bound on the position error anywhere for 95 % of machines drawn from a posterior, mm.

    mean (G, 2) error at the posterior mean, jacobian (G, 2, P), covariance (P, P); an unknown without finite
    variance must not move anything.
    """
    return largest_error_bounds((mean,), jacobian, covariance)[0]


def largest_error_bounds(means: Sequence[Real], jacobian: Real, covariance: Real) -> list[float]:
    """The same for several errors at the posterior mean, each (G, 2).

    |m + a|^2 for all means m and draws a at a position is one product, (2 m, 1, |m|^2) (a, |a|^2, 1)'.
    """
    mean = np.stack(means, axis=1)
    of_means = np.dstack([2.0 * mean, np.ones(mean.shape[:2]), np.sum(mean**2, axis=2)])
    of_draws = np.ones((BLOCK, 4, DRAWS))
    largest, squares = np.zeros((2, len(means), DRAWS))
    for places, apart in _drawn(jacobian, covariance):
        of_draws[: len(apart), :2] = apart
        apart *= apart
        np.add(apart[:, 0], apart[:, 1], out=of_draws[: len(apart), 2])
        for of_mean, drawn in zip(of_means[places], of_draws, strict=False):
            np.maximum(largest, np.matmul(of_mean, drawn, out=squares), out=largest)
    bounds: list[float] = np.sqrt(_quantile_95(largest)).tolist()
    return bounds


def expected_largest_error_bound(means: Real, jacobian: Real, covariance: Real) -> float:
    """The mean of that bound over several error fields (M, G, 2) that the posterior mean may have, mm."""
    return float(np.mean(largest_error_bounds(tuple(means), jacobian, covariance)))


def error_bounds(mean: Real, jacobian: Real, covariance: Real) -> Real:
    """(G,) the same for each position separately."""
    squares = (_squares(mean[places], apart) for places, apart in _drawn(jacobian, covariance))
    return np.asarray(np.sqrt(np.concatenate([_quantile_95(of) for of in squares])))


def _quantile_95(squares: Real) -> Real:
    """(N,) 95 % quantile of each row (N, DRAWS), interpolated; `np.quantile` takes five times as long."""
    k, share = divmod(0.95 * (DRAWS - 1), 1.0)
    parted = np.partition(squares, (int(k), int(k) + 1), axis=1)
    below, above = parted[:, int(k)], parted[:, int(k) + 1]
    return np.asarray(below + share * (above - below))


def _squares(mean: Real, apart: Real) -> Real:
    """(B, DRAWS) squares of errors that differ from the mean (B, 2) by (B, 2, DRAWS)."""
    error = apart + mean[:, :, None]
    error *= error
    return np.asarray(np.add(error[:, 0], error[:, 1], out=error[:, 0]))


def _drawn(jacobian: Real, covariance: Real) -> Iterator[tuple[slice, Real]]:
    """Deviations from the mean of machines drawn from a posterior, at some positions (B, 2, DRAWS), block by
    block; always the same machines.

    The largest of many correlated lengths has no closed form. Blocks keep the intermediate arrays in the
    processor's cache; the array is used again for the next block.
    """
    finite = np.isfinite(np.diag(covariance))
    sd = np.sqrt(np.diag(covariance)[finite])
    values, vectors = np.linalg.eigh(covariance[np.ix_(finite, finite)] / np.outer(sd, sd))
    root = sd[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
    errors = (jacobian[:, :, finite] @ root).reshape(-1, len(sd))
    # the largest error is nearly a function of one direction: strata along the principal ones pay most
    by_draw = (errors @ np.linalg.eigh(errors.T @ errors)[1]).reshape(*jacobian.shape[:2], len(sd))
    standard = _standard_normal(len(sd))
    apart = np.empty((BLOCK, 2, DRAWS))
    for first in range(0, len(by_draw), BLOCK):
        of_block = by_draw[first : first + BLOCK]
        out = apart[: len(of_block)]
        np.matmul(of_block.reshape(-1, len(sd)), standard, out=out.reshape(-1, DRAWS))
        yield slice(first, first + BLOCK), out


@lru_cache(maxsize=8)
def _standard_normal(size: int) -> Real:
    """(size, DRAWS) standard normal numbers, in each row one from each of DRAWS strata (Latin hypercube)."""
    strata = np.tile(np.arange(DRAWS), (size, 1))
    drawn = np.asarray(ndtri((np.random.default_rng(0).permuted(strata, axis=1) + 0.5) / DRAWS))
    drawn.setflags(write=False)
    return drawn
