"""The method as published (paper section 4 and 5): differences of adjacent positions, LS, TSVD, MAEMM.

Unknowns of eq. 28: (L dtheta1, L dtheta2, rMx, rMy) in mm; of eq. 24: the twelve of
`station.five_bar.error_model` with the zero offsets as L dtheta.  theta are nominal joint angles with the
known zero offsets already added.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.five_bar import KEPT, Geometry, distance_jacobian, pose
from station.records import Complex, Real


def distance_rows(geometry: Geometry, theta: Real, drm: complex = 0j) -> Real:
    """(K, 12) g'_k of eq. 21, columns L dtheta; with the MAEMM known so far, along f of eq. 30.

     f = lambda - dr_M: the minus sign is the one that agrees with the paper's own kappa_m
    ; as printed, with a plus, the modification leads away.
    """
    at = pose(Geometry(geometry.e, geometry.L, geometry.l, geometry.cd + drm), theta)
    rows = distance_jacobian(geometry, at)
    rows[:, :2] /= geometry.L
    return rows


def identification_matrix(geometry: Geometry, theta: Real, drm: complex = 0j) -> Real:
    """G (K-1, 4) of eq. 28, adjacent rows subtracted in the order the positions were measured."""
    return np.diff(distance_rows(geometry, theta, drm)[:, KEPT], axis=0)


def full_identification_matrix(geometry: Geometry, theta: Real) -> Real:
    """G' (K-1, 12) of eq. 24.  Its rank is 9 for any K, not 12 as printed."""
    return np.diff(distance_rows(geometry, theta), axis=0)


def least_squares(G: Real, delta_lambda: Real) -> Real:
    """Eq. 25.

    :raises numpy.linalg.LinAlgError: the normal matrix is singular.
    """
    return np.asarray(np.linalg.solve(G.T @ G, G.T @ delta_lambda))


def tsvd(G: Real, delta_lambda: Real, t: int) -> Real:
    """Eq. 27 and 29: the sum over the t largest singular values."""
    U, sigma, Vt = np.linalg.svd(G, full_matrices=False)
    return np.asarray(Vt[:t].T @ ((U[:, :t].T @ delta_lambda) / sigma[:t]))


@dataclass(frozen=True, slots=True)
class Identified:
    """One identification of eq. 29 or 30."""

    dtheta: Real
    """(2,) rad."""
    drm: complex
    """Increment of the MAEMM, mm."""
    gain: Real
    """(4, K) derivative of (dtheta1, dtheta2, rMx, rMy) by each reading: the propagation of noise."""
    residual: Real
    """(K-1,) mm, of the adjacent differences."""
    condition: float
    """kappa of the identification matrix."""


def identify(geometry: Geometry, theta: Real, rho: Real, drm: complex = 0j) -> Identified:
    """Eq. 29 (drm = 0) or eq. 30 (drm = the sum found so far) from readings rho (K,), any constant offset.

    :raises ValueError: fewer than the five positions that section 5 requires.
    """
    if len(rho) < 5:
        raise ValueError(f"the published method needs at least 5 positions, got {len(rho)}")
    at = pose(Geometry(geometry.e, geometry.L, geometry.l, geometry.cd + drm), theta)
    G = identification_matrix(geometry, theta, drm)
    delta_lambda = np.diff(rho - at.rho)
    solution = tsvd(G, delta_lambda, 4)
    gain = np.linalg.pinv(G) @ np.diff(np.eye(len(rho)), axis=0)
    gain[:2] /= geometry.L[:, None]
    return Identified(
        dtheta=solution[:2] / geometry.L,
        drm=complex(solution[2], solution[3]),
        gain=gain,
        residual=delta_lambda - G @ solution,
        condition=float(np.linalg.cond(G)),
    )


def compensation_accuracy(later: Real, earlier: Real) -> float:
    """Mu of eq. 32 between two successive identifications of dtheta (2,), same unit as given."""
    return float(np.sqrt(np.mean((later - earlier) ** 2)))


def boundary_positions(workspace_x: tuple[float, float], workspace_y: tuple[float, float], n: int) -> Complex:
    """(2n,) positions of Fig. 7: n on the upper edge left to right, then n on the lower edge.

    This order, with the same direction on both edges, is the one that gives the printed
    kappa_1 = 475.34.
    """
    x = np.linspace(*workspace_x, n)
    return np.concatenate([x + 1j * workspace_y[1], x + 1j * workspace_y[0]])
