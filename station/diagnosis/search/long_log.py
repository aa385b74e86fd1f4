"""The steps of the loop that thousands of readings and hundreds of amplitudes need done with care for time.

An effect is added from the linear answer on, spreads and all, so that one nonlinear fit settles it; readings
left out are taken out of a fit instead of fitting all others anew.
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
    """The scanned fit with one effect more; rows scatter by what is left, or as specified if that is more.

    :raises NotConvergedError: no convergence.
    """
    left = (scan.fit.cost - candidate.reduction) / max(scan.fit.dof, 1)
    return _learned(scan.fit, [(candidate.term(), scan.signature(candidate))], left, prior)


def settled(found: Fit, prior: Prior) -> Fit:
    """A fit once more, with noise and spreads as its readings want them.

    :raises NotConvergedError: no convergence.
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
    """Another fit by a linear step from one found; singular values are left as they were."""
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
