"""Inverse and forward position of the five-bar (paper section 2), vectorised over positions.

Points are complex numbers x + iy in mm, joint angles rad, arrays of K positions have shapes
r (K,) and theta (K, 2).  Assembly mode of Fig. 4: elbows outward, P below the elbows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.records import Complex, Real

HOME = np.array([0.0, np.pi])
"""Joint angles of P_0 (section 3)."""


@dataclass(frozen=True, slots=True)
class Geometry:
    """Lengths and centres of one five-bar with its measuring mechanism, mm."""

    e: Complex
    """(2,) centres A_i."""
    L: Real
    """(2,) proximal lengths."""
    l: Real  # noqa: E741 - the paper's symbol
    """(2,) distal lengths."""
    cd: complex | Complex
    """c + d, one for all or (K,) one per pose: the distance depends only on their sum (eq. 4)."""


_ELBOW = np.array([1.0, -1.0])
"""Side of the elbow seen from A_i: limb 1 turns ahead of the line A_i P, limb 2 behind it."""


class Unreachable(ValueError):
    """A position or a pair of joint angles at which the linkage does not close."""

    def __init__(self, indices: NDArray[np.intp], text: str) -> None:
        super().__init__(text)
        self.indices = indices


def inverse(geometry: Geometry, r: Complex) -> Real:
    """Eq. 3: joint angles theta (K, 2) that bring P to r (K,).

    The half-angle form of eq. 3 is solved as the triangle A_i B_i P it stands for; the paper's
    print has the signs of D^2 and E^2 under the root exchanged (docs/explanation/method.md).

    :raises Unreachable: naming the first position out of reach.
    """
    reach = np.asarray(r)[:, None] - geometry.e
    distance = np.abs(reach)
    cosine = (distance**2 + geometry.L**2 - geometry.l**2) / (2.0 * geometry.L * distance)
    bad = np.flatnonzero(~(np.abs(cosine) <= 1.0).all(axis=1))
    if bad.size:
        x, y = r[bad[0]].real, r[bad[0]].imag
        raise Unreachable(bad, f"position ({x:.1f}, {y:.1f}) mm is out of reach.")
    theta = np.angle(reach) + _ELBOW * np.arccos(cosine)
    return np.asarray(HOME + np.remainder(theta - HOME + np.pi, 2.0 * np.pi) - np.pi)


def elbows(geometry: Geometry, theta: Real) -> Complex:
    """B_i = e_i + L_i u_i (K, 2), from eq. 1."""
    return np.asarray(geometry.e + geometry.L * np.exp(1j * theta))


def close_linkage(B: Complex, l: Real) -> Complex:  # noqa: E741
    """Eq. 5 to 8: P (K,) where circles of radius l_i about the elbows B (K, 2) meet, lower branch.

    NaN where they do not meet; callers silence or refuse that.
    """
    foot = B[:, 1]
    span = B[:, 0] - foot
    square = (span * span.conj()).real
    first, second = float(l[0]) ** 2, float(l[1]) ** 2
    along = 0.5 + (0.5 * (second - first)) / square
    across = np.sqrt(second / square - along * along)
    return np.asarray(foot + span * (along - 1j * across))


def forward(geometry: Geometry, theta: Real) -> Complex:
    """Eq. 5 to 8: position r (K,) of P for joint angles theta (K, 2).

    :raises Unreachable: naming the first pose at which the linkage does not close.
    """
    with np.errstate(invalid="ignore"):
        r = close_linkage(elbows(geometry, theta), geometry.l)
    bad = np.flatnonzero(np.isnan(r))
    if bad.size:
        angles = np.degrees(theta[bad[0]])
        raise Unreachable(bad, f"the linkage does not close at {angles[0]:.3f}, {angles[1]:.3f} deg.")
    return r
