"""The choice of the next position: the benefit of one more reading per second.

A reading with whitened derivatives a (P,) changes the covariance C of all unknowns by the rank-one update C -
C a a' C / (1 + a' C a).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri, chndtr

from station.records import Index, Real

ALONE = 0.3
"""Directions with less than this share of the memory's information cannot contradict it."""


def gains(covariance: Real, rows: Real, weight: Real) -> Real:
    """(N,) reduction of trace(C M) by a reading with derivatives rows (N, P), M = weight (P, P)."""
    spread = rows @ covariance
    gain = np.einsum("ni,ni->n", spread @ weight, spread)
    return np.asarray(gain / (1.0 + np.einsum("ni,ni->n", spread, rows)))


def with_readings(covariance: Real, rows: Real) -> Real:
    """(P, P) covariance after readings with derivatives rows (R, P)."""
    spread = rows @ covariance
    told = np.eye(len(rows)) + spread @ rows.T
    return np.asarray(covariance - spread.T @ np.linalg.solve(told, spread))


@dataclass(frozen=True)
class Contradiction:
    """The ability of readings to contradict the memory, if the machine had changed."""

    remembered: Real
    """(M, M) covariance of the memory."""
    lasting: Index
    """(M,) indices of the remembered parameters among the unknowns."""
    passing: Index
    """(P - M,) unknowns that the memory does not contain."""
    known: Real
    """(P - M,) prior information about those; 0 for none."""
    p_value: float
    """Below it the memory is dropped."""

    def noncentrality(self, information: Real, changes: Real) -> Real:
        """(..., D) noncentrality of the test for each change (D, M) of the remembered parameters, from the
        information of the readings (..., P, P) alone.

        The misfit of the memory has the covariance of the memory and that of the readings, with the unknowns
        that the memory does not contain projected out.
        """
        told = self._told(information)
        # (A^-1 + C)^-1 = A (1 + C A)^-1, which needs no inverse of A
        test = told @ np.linalg.inv(np.eye(len(self.lasting)) + self.remembered @ told)
        return np.asarray(np.einsum("...dj,dj->...d", changes @ test, changes))

    def directions(self, information: Real) -> Index:
        """(...,) number of directions in which the readings could contradict the memory."""
        root = np.linalg.cholesky(self.remembered)
        values = np.linalg.eigvalsh(root.T @ self._told(information) @ root)
        return np.asarray(np.sum(values > ALONE**2, axis=-1))

    def power(self, noncentrality: Real, directions: Index) -> Real:
        """(..., D) probability that the memory is dropped; 0 where nothing can contradict it."""
        count = np.maximum(directions, 1)
        found = 1.0 - chndtr(chdtri(count, self.p_value)[..., None], count[..., None], noncentrality)
        return np.asarray(np.where(directions[..., None] > 0, found, 0.0))

    def _told(self, information: Real) -> Real:
        """(..., M, M) information of the readings on the remembered parameters."""
        kept, p = self.lasting, self.passing
        cross = information[..., kept[:, None], p]
        rest = information[..., p[:, None], p] + np.diag(self.known)
        own = information[..., kept[:, None], kept]
        return np.asarray(own - cross @ np.linalg.solve(rest, np.swapaxes(cross, -1, -2)))


def turned(size_mm: float, count: int = 72) -> Real:
    """(count, 2) displacements of one length in all directions."""
    angle = 2.0 * np.pi * np.arange(count) / count
    return size_mm * np.column_stack([np.cos(angle), np.sin(angle)])


def changes_of(names: Sequence[str], remount_mm: float, link_mm: float) -> Real:
    """(D, M) possible changes of the remembered parameters: the mechanism remounted in some direction, one
    link changed.
    """
    links = [k for k, name in enumerate(names) if name in ("L1", "L2", "l1", "l2")]
    changes = link_mm * np.eye(len(names))[links]
    if "rMx" not in names:
        return changes
    around = turned(remount_mm)
    mounted = np.zeros((len(around), len(names)))
    mounted[:, [names.index("rMx"), names.index("rMy")]] = around
    return np.vstack([mounted, changes])
