"""Blocked cross-validation: every reading predicted without any reading of its own position."""

from __future__ import annotations

import numpy as np

from station.errors import InputRefused
from station.fitting import Solution, solved
from station.mechanism import Mechanism
from station.model import Fit
from station.records import Flags, Index, Measurements, Real

DETERMINED = 1e-9
"""A block that alone determines a direction cannot be predicted in it by the others."""

LONG = 1000
"""Number of readings from which neighbours in the log are excluded together, a quarter of it at a time."""
FOLDS = 4
BLOCK = 40
"""Consecutive readings that stay together then, fewer where the log"""
BLOCKS_A_FOLD = 2
"""would have fewer blocks than these in each fold."""


def predicted_by_others(solution: Solution, mechanism: Mechanism) -> Real:
    """(R,) whitened measured less predicted, by a fit without the position; in long logs, the block."""
    m, reading = mechanism.measurements, mechanism.reading_of_row
    if len(m) < LONG:
        return held_out(solution, m.position[reading])
    return held_out_folds(solution, folds(m)[reading])


def folds(m: Measurements) -> Index:
    """(K,) fold of each reading: blocks of neighbours dealt out in turn, each position in one fold only.

    Each set-up is dealt out separately, so that none is missing on one side.
    """
    return np.asarray(_blocks(m)[0] % FOLDS)


def without_neighbours(found: Fit) -> Real:
    """(R,) mm, measured less predicted by a fit without the block of neighbours; in long logs, the fold."""
    mechanism = found.model.mechanism
    m = mechanism.measurements
    block, setup = _blocks(m)
    group = folds(m) if len(m) >= LONG else block + setup * (int(block.max()) + 1)
    return held_out_folds(found.solution, group[mechanism.reading_of_row]) * found.row_sd


def _blocks(m: Measurements) -> tuple[Index, Index]:
    """(K,) number of each reading's block of neighbours within its set-up, and (K,) the set-up."""
    out = np.zeros(len(m), dtype=np.intp)
    for s in range(len(m.setups)):
        own = np.flatnonzero(m.setup_index == s)
        _, first, place, count = np.unique(
            m.position[own], return_index=True, return_inverse=True, return_counts=True
        )
        visited = np.argsort(first)
        # readings rather than rows are counted: later visits to a position belong to its first one
        before = np.empty_like(count)
        before[visited] = np.cumsum(count[visited]) - count[visited]
        block = min(BLOCK, max(1, len(own) // (FOLDS * BLOCKS_A_FOLD)))
        out[own] = before[place] // block
    return out, m.setup_index


def without_a_quarter(m: Measurements) -> tuple[Measurements, Measurements]:
    """Readings to learn from, and a quarter of them, in blocks of neighbours, to be judged by.

    :raises InputRefused: there are so few positions that one side is empty.
    """
    fold = folds(m)
    aside = fold == _nearest_to_a_quarter(fold)
    if aside.all() or not aside.any():
        raise InputRefused(
            f"{len(m)} readings at {len(np.unique(m.position))} positions cannot be divided into readings to "
            "learn from and others to judge by; measure more positions, or diagnose without --hold-out."
        )
    return m.take(~aside), m.take(aside)


def _nearest_to_a_quarter(fold: Index) -> int:
    """The first fold with a quarter of the readings, by half of that more or less, or the nearest to it.

    A position that is visited again and again, such as a home pose, can make a fold far larger.
    """
    quarter = len(fold) / FOLDS
    off = np.abs(np.bincount(fold, minlength=FOLDS) - quarter)
    return int(np.argmin(np.maximum(off - quarter / 2.0, 0.0)))


def left_out_rms(found: Fit) -> float:
    """RMS of readings predicted without the fold of blocks that they are in, mm."""
    mechanism = found.model.mechanism
    fold = folds(mechanism.measurements)[mechanism.reading_of_row]
    rows = held_out_folds(found.solution, fold) * found.row_sd
    return float(np.sqrt(rows @ rows / len(mechanism.measurements)))


def held_out_folds(solution: Solution, fold: Index) -> Real:
    """(R,) the same for folds larger than the number of unknowns."""
    out = -solution.residual
    for f in np.unique(fold):
        own = fold == f
        out[own] = left_without(solution, own)[own]
    return out


def left_without(solution: Solution, own: Flags) -> Real:
    """(R,) whitened measured less predicted of all rows, by the linear fit without the rows `own` (R,).

    r + J (C^-1 - J_B'J_B)^-1 J_B' r_B.
    """
    finite = np.isfinite(np.diag(solution.covariance))
    J, C = solution.jacobian[:, finite], solution.covariance[np.ix_(finite, finite)]
    J_B, out = J[own], -solution.residual
    return np.asarray(out + J @ solved(np.eye(len(C)) - C @ (J_B.T @ J_B), C @ (J_B.T @ out[own])))


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
