"""Blocked cross-validation: every reading predicted without any reading of its own place."""

from __future__ import annotations

import numpy as np

from station.kinematics import Real
from station.least_squares import Solution
from station.measurements import Index

DETERMINED = 1e-9
"""A block that alone holds a direction cannot be predicted in it by the others."""


def held_out(solution: Solution, block: Index) -> Real:
    """(R,) whitened measured less predicted, each block (R,) predicted by the fit to all others.

    Leaving block B out of a linear least-squares fit turns its residual r_B into
    (I - H_BB)^-1 r_B, H = J C J' being the hat matrix of the fit with its prior (Cook and Weisberg,
    Residuals and Influence in Regression, 1982, section 3.6).  Searched parameters of the model are
    not searched again.
    """
    finite = np.isfinite(np.diag(solution.covariance))
    J, C = solution.jacobian[:, finite], solution.covariance[np.ix_(finite, finite)]
    r = -solution.residual
    out = np.empty_like(r)
    count = np.bincount(block)
    order = np.argsort(block, kind="stable")
    for size in np.unique(count[count > 0]):
        own = order[count[block[order]] == size].reshape(-1, size)
        left = np.eye(size) - J[own] @ C @ J[own].swapaxes(1, 2)
        out[own] = np.squeeze(np.linalg.pinv(left, rcond=DETERMINED, hermitian=True) @ r[own][:, :, None], 2)
    return out
