"""The steps of the loop that need care for time with thousands of readings and hundreds of amplitudes.

An effect is added starting from the linear solution, spreads included, so that one nonlinear fit settles it;
excluded readings are taken out of a fit instead of fitting all others again.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.search.evidence import relearned
from station.diagnosis.search.scan import Candidate, Scan
from station.fitting import Prior, solved
from station.model import Fit, Model, Term, fit
from station.records import Flags, Real


def with_candidate(scan: Scan, candidate: Candidate, prior: Prior) -> Fit:
    """The scanned fit with one more effect; rows scatter by the residual, or as specified if that is more.

    :raises NotConvergedError: the fit does not converge.
    """
    left = (scan.fit.cost - candidate.reduction) / max(scan.fit.dof, 1)
    return _learned(scan.fit, [(candidate.term(), scan.signature(candidate))], left, prior)


def settled(found: Fit, prior: Prior) -> Fit:
    """The fit again, with noise and spreads set by its readings.

    :raises NotConvergedError: the fit does not converge.
    """
    return _learned(found, [], found.cost / max(found.dof, 1), prior)


def _learned(found: Fit, added: list[tuple[Term, Real]], noise: float, prior: Prior) -> Fit:
    terms, x, noise = relearned(found, added, noise)
    return fit(replace(found.model, terms=terms), prior, found.row_sd * np.sqrt(noise), x)


def without(found: Fit, kept: Flags) -> Fit:
    """The fit to the readings `kept` (K,) only; exact where the model is linear."""
    mechanism = found.model.mechanism
    row = kept[mechanism.reading_of_row]
    old, C = found.solution, found.solution.covariance
    J_B, r_B = old.jacobian[~row], old.residual[~row]
    smaller = solved(np.eye(len(C)) - C @ (J_B.T @ J_B), C)
    moved = smaller @ (J_B.T @ r_B)
    residual = old.residual[row] + old.jacobian[row] @ moved
    model = replace(found.model, mechanism=mechanism.of(mechanism.measurements.take(kept)))
    return _moved(
        found, model, found.prior, old.x + moved, smaller, residual, old.jacobian[row], found.row_sd[row]
    )


def less(found: Fit, k: int, prior: Prior) -> Fit:
    """The fit without its term k; exact where the model is linear."""
    model = replace(found.model, terms=(*found.model.terms[:k], *found.model.terms[k + 1 :]))
    old, C, own = found.solution, found.solution.covariance, found.part(k)
    keep = np.setdiff1d(np.arange(len(old.x)), own)
    along = solved(C[np.ix_(own, own)], C[own]).T
    moved = -along @ old.x[own]
    residual = old.residual + old.jacobian @ moved
    smaller = (C - along @ C[own])[np.ix_(keep, keep)]
    held = model.prior(prior)
    return _moved(
        found, model, held, (old.x + moved)[keep], smaller, residual, old.jacobian[:, keep], found.row_sd
    )


def _moved(
    found: Fit, model: Model, prior: Prior, x: Real, covariance: Real, residual: Real, J: Real, row_sd: Real
) -> Fit:
    """A fit one linear step from another; its singular values are unchanged."""
    pull = prior.root @ (x - prior.mean)
    solution = replace(
        found.solution,
        x=x,
        covariance=(covariance + covariance.T) / 2.0,
        cost=float(residual @ residual + pull @ pull),
        residual=residual,
        jacobian=J,
    )
    return Fit(model, solution, prior, row_sd)
