"""The size of the amplitudes of a curve, learned from the readings themselves.

A curve of a hundred amplitudes needs a prior, and its width decides between underfitting and following the
noise. The width that makes the readings most probable is found by the fixed-point steps of MacKay (Bayesian
interpolation, Neural Computation 4, 1992): the variance of each band of similar amplitudes is the square sum
of its posterior means, over the number of them that the readings determine.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.linalg.lapack import dpotri

from station.effects import Effect
from station.fitting import positive
from station.model import Fit, Term
from station.records import Index, Real

MOST_ROUNDS = 8
SETTLED = 0.05
"""Relative change of every spread at which the search ends."""
SMALLEST_RAD = 1e-7
"""A band whose amplitudes scatter by less counts as absent."""
NONE = -1
"""Band of an unknown whose prior is not learned."""


def learned_spread(information: Real, gradient: Real, spread: Real, bands: Index) -> tuple[Real, Real]:
    """(Q,) spreads of Q unknowns, starting from `spread` (Q,), and their posterior mean (Q,).

    Unknowns in no band retain their spread (inf for none). information (Q, Q) and gradient (Q,) come from the
    readings, and from priors beside the spreads.
    """
    spread = spread.copy()
    learned = bands != NONE
    band = bands[learned]
    for _ in range(MOST_ROUNDS):
        factor = cho_factor(positive(information + np.diag(1.0 / spread**2)), lower=True)
        mean = cho_solve(factor, gradient)
        if not learned.any():
            break
        inverse, _ = dpotri(factor[0], lower=True)
        free = 1.0 - np.diag(inverse)[learned] / spread[learned] ** 2
        determined = np.bincount(band, np.maximum(free, 0.0))
        square = np.bincount(band, mean[learned] ** 2) / np.maximum(determined, 1e-9)
        better = np.maximum(np.sqrt(square), SMALLEST_RAD)[band]
        settled = np.abs(np.log(better / spread[learned])).max() < SETTLED
        spread[learned] = better
        if settled:
            break
    return spread, mean


def relearned(
    fit: Fit, added: Sequence[tuple[Term, Real]], noise: float
) -> tuple[tuple[Term, ...], Real, float]:
    """The terms of a fit and added ones, with every spread set by the readings; all unknowns (X,); the noise.

    The fit is linear about its solution; each term has its signature (R, q), mm per unit of amplitude; noise,
    initially as guessed, is the variance of a row over that of row_sd, but no less than specified. Noise and
    spreads depend on each other and are determined together.
    """
    terms = (*fit.model.terms, *(term for term, _ in added))
    model = replace(fit.model, terms=terms)
    least = float(np.mean((fit.model.mechanism.row_sd / fit.row_sd) ** 2))
    J = np.hstack([fit.solution.jacobian, *(signature / fit.row_sd[:, None] for _, signature in added)])
    x = np.concatenate([fit.x, np.zeros(model.unknowns - len(fit.x))])
    size = model.base_size
    root = np.zeros((len(fit.prior.root), len(x)))
    root[:, :size] = fit.prior.root[:, :size]
    mean = np.zeros(len(x))
    mean[:size] = fit.prior.mean[:size]
    normal, held = J.T @ J, root.T @ root
    toward, pull = normal @ x - J.T @ fit.solution.residual, held @ mean
    spread = np.concatenate([np.full(size, np.inf), model.spread])
    bands = _bands(terms, size)
    dof = fit.dof - sum(term.size for term, _ in added if term.spread is None)
    for _ in range(MOST_ROUNDS):
        spread, at = learned_spread(normal / noise + held, toward / noise + pull, spread, bands)
        residual = fit.solution.residual + J @ (at - x)
        pulled = np.sum((at / spread) ** 2) + np.sum((root @ (at - mean)) ** 2)
        change = max((float(residual @ residual) / noise + float(pulled)) / dof, least / noise)
        noise *= change
        if abs(np.log(change)) < SETTLED:
            break
    out, first = [], size
    for one in terms:
        own = spread[first : first + one.size]
        out.append(one if one.spread is None else replace(one, spread=own))
        first += one.size
    return tuple(out), at, noise


def _bands(terms: tuple[Term, ...], size: int) -> Index:
    """(size + amplitudes,) band number, shared by all effects of a kind: reducers of one arm are similar."""
    parts, first = [np.full(size, NONE, dtype=np.intp)], 0
    kinds: dict[type[Effect], int] = {}
    for term in terms:
        if term.spread is None:
            parts.append(np.full(term.size, NONE, dtype=np.intp))
            continue
        own = term.effect.bands(term.size)
        if type(term.effect) not in kinds:
            kinds[type(term.effect)] = first
            first += int(own.max()) + 1
        parts.append(own + kinds[type(term.effect)])
    return np.concatenate(parts)
