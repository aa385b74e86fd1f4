"""Linear systems that may be singular, solved as far as double precision permits."""

from __future__ import annotations

import numpy as np

from station.records import Real

POSITIVE = 1e-12
"""Smallest eigenvalue of a matrix made positive definite, over the largest, with unit diagonal."""


def solved(matrix: Real, right: Real) -> Real:
    """matrix^-1 right; for a singular matrix, the shortest solution."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.lstsq(matrix, right, rcond=None)[0])


def positive(matrix: Real) -> Real:
    """The symmetric matrix itself where it is positive definite, otherwise the nearest such matrix.

    Differences of nearly equal matrices (information less the part that other unknowns take up) lose
    definiteness by rounding.
    """
    scale = np.sqrt(np.maximum(np.diag(matrix), 0.0))
    scale[scale == 0.0] = 1.0
    unit = matrix / np.outer(scale, scale)
    try:
        np.linalg.cholesky(unit)
    except np.linalg.LinAlgError:
        values, vectors = np.linalg.eigh((unit + unit.T) / 2.0)
        unit = (vectors * np.maximum(values, POSITIVE * values[-1])) @ vectors.T
        return np.asarray(unit * np.outer(scale, scale))
    return matrix
