"""The steps of the loop that thousands of readings and hundreds of amplitudes need done with care for time.

An effect is added from the linear answer on, spreads and all, so that one nonlinear fit settles it; readings
left out are taken out of a fit instead of fitting all others anew.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.diagnosis.evidence import grown
from station.diagnosis.model import Fit, fit, fitted
from station.diagnosis.scan import Candidate, Scan
from station.least_squares import Prior, Solution


def with_candidate(scan: Scan, candidate: Candidate, prior: Prior) -> Fit:
    """The scanned fit with one effect more; rows scatter by what is left, or as specified if that is more.

    :raises NotConvergedError: no convergence.
    """
    current = scan.fit
    specified = current.model.mechanism.row_sd
    left = (current.cost - candidate.reduction) / max(current.dof, 1)
    noise = max(left, float(np.mean((specified / current.row_sd) ** 2)))
    terms, x = grown(current, candidate.term(), scan.signature(candidate), noise)
    model = replace(current.model, terms=terms)
    return fit(model, prior, current.row_sd * np.sqrt(noise), x)


def without(found: Fit, kept: NDArray[np.bool_]) -> Fit:
    """The fit to the readings `kept` (K,) only; exact where the model is linear."""
    mechanism = found.model.mechanism
    row = kept[mechanism.reading_of_row]
    old, C = found.solution, found.solution.covariance
    J_B, r_B = old.jacobian[~row], old.residual[~row]
    smaller = np.linalg.solve(np.eye(len(C)) - C @ (J_B.T @ J_B), C)
    moved = smaller @ (J_B.T @ r_B)
    residual = old.residual[row] + old.jacobian[row] @ moved
    x = old.x + moved
    pull = found.prior.root @ (x - found.prior.mean)
    solution = Solution(
        x=x,
        covariance=(smaller + smaller.T) / 2.0,
        singular_values=old.singular_values,
        directions=old.directions,
        scale=old.scale,
        cost=float(residual @ residual + pull @ pull),
        residual=residual,
        jacobian=old.jacobian[row],
        steps=old.steps,
    )
    model = replace(found.model, mechanism=mechanism.of(mechanism.measurements.take(kept)))
    return fitted(model, solution, found.prior, found.row_sd[row])
