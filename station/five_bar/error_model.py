"""First-order errors of position and distance (paper section 3, eq. 9 to 20), in closed form.

Parameter order everywhere: dtheta1, dtheta2 (rad), e1x, e1y, e2x, e2y, L1, L2, l1, l2, rMx, rMy (mm). These
are deviations from the nominal geometry.  Everything follows from one line, eq. 11: w_i . dr = w_i . dB_i +
dl_i, where dB_i is the motion of the elbow.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from station.five_bar.kinematics import Geometry, close_linkage
from station.records import Complex, Real

NAMES = (
    "dtheta1", "dtheta2", "e1x", "e1y", "e2x", "e2y", "L1", "L2", "l1", "l2", "rMx", "rMy",
)  # fmt: skip
SIZE = len(NAMES)


def perturbed(nominal: Geometry, p: Real) -> Geometry:
    """The geometry with deviations p (12,) added; the MAEMM rMx, rMy adds to c + d (eq. 17)."""
    return Geometry(
        e=nominal.e + np.ascontiguousarray(p[2:6]).view(complex),  # pairs of x and y
        L=nominal.L + p[6:8],
        l=nominal.l + p[8:10],
        cd=nominal.cd + complex(p[10], p[11]),
    )


class Pose(NamedTuple):
    """One evaluation of the linkage at K poses, with all quantities that derivatives need."""

    r: Complex
    """(K,) position of P."""
    rho: Real
    """(K,) length of O_1 O_2 (eq. 14, 15)."""
    elbow_arm: Complex
    """(K, 2) L_i u_i."""
    w: Complex
    """(K, 2) unit vectors of the distal links."""
    direction: Complex
    """(K,) unit vector of O_1 O_2."""


def pose(geometry: Geometry, theta: Real) -> Pose:
    """Solve the linkage at actual joint angles theta (K, 2); NaN where it does not close."""
    arm = geometry.L * np.exp(1j * theta)
    B = geometry.e + arm
    r = close_linkage(B, geometry.l)
    lam = r - geometry.cd
    rho = np.abs(lam)
    return Pose(r, rho, arm, (r[:, None] - B) / geometry.l, lam / rho)


def link_shares(at: Pose) -> Real:
    """(K, 2) alpha with direction = alpha_1 w_1 + alpha_2 w_2: effect of each limb's dB_i + dl_i on rho."""
    w1, w2 = at.w[:, 0], at.w[:, 1]
    conjugate = at.direction.conj()
    # the imaginary part of conj(a) b is the cross product a x b
    alpha = np.empty(at.w.shape)
    alpha[:, 0] = (conjugate * w2).imag
    alpha[:, 1] = -(conjugate * w1).imag
    alpha /= (w1.conj() * w2).imag[:, None]
    return alpha


def distance_by_joint(at: Pose) -> Real:
    """(K, 2) d rho / d theta_i in mm/rad: lambda-hat . J of eq. 19 with eq. 13."""
    # w . (Q L u) with Q a quarter turn: Re(conj(w) i L u) = -Im(conj(w) L u)
    return np.asarray(link_shares(at) * (at.w * at.elbow_arm.conj()).imag)


def distance_jacobian(geometry: Geometry, at: Pose) -> Real:
    """(K, 12) d rho / d p: the rows g'_k of eq. 21, zero offsets per rad."""
    alpha = link_shares(at)
    along_arm = at.w * at.elbow_arm.conj()
    pulled = alpha * at.w
    jacobian = np.empty((len(at.r), SIZE))
    jacobian[:, 0:2] = alpha * along_arm.imag
    jacobian[:, 2:6:2] = pulled.real
    jacobian[:, 3:6:2] = pulled.imag
    jacobian[:, 6:8] = alpha * along_arm.real / geometry.L
    jacobian[:, 8:10] = alpha
    jacobian[:, 10] = -at.direction.real
    jacobian[:, 11] = -at.direction.imag
    return jacobian


def position_jacobian(geometry: Geometry, at: Pose) -> Real:
    """(K, 2, 12) d (x, y) / d p: J' of eq. 12 (zero offsets per rad; the MAEMM moves nothing)."""
    w, arm = at.w, at.elbow_arm
    rows = np.zeros((len(at.r), 2, SIZE))
    for i in range(2):
        wi, ai = w[:, i], arm[:, i]
        rows[:, i, i] = wi.imag * ai.real - wi.real * ai.imag
        rows[:, i, 2 + 2 * i] = wi.real
        rows[:, i, 3 + 2 * i] = wi.imag
        rows[:, i, 6 + i] = (wi.real * ai.real + wi.imag * ai.imag) / geometry.L[i]
        rows[:, i, 8 + i] = 1.0
    # [w_1 w_2]^T dr = rows dp
    both = np.stack([w.real, w.imag], axis=-1)
    return np.asarray(np.linalg.solve(both, rows))


KEPT = (0, 1, 10, 11)
"""Parameters that eq. 28 retains of the twelve: zero offsets and MAEMM."""
