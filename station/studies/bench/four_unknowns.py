"""The paper's four unknowns on raw readings: zero offsets, MAEMM and one reading offset.

The geometry is taken as exact (eq. 13, 28); raw readings with one unknown offset carry what adjacent
differences carry, without their correlated noise and whatever the order.
"""

from __future__ import annotations

import numpy as np

from station.five_bar import Geometry, distance_by_joint, pose
from station.mechanism import Observation
from station.records import Real


def observe_four_unknowns(geometry: Geometry, p: Real, theta: Real) -> Observation:
    """(K,) head readings at p (5,) and feedback angles theta (K, 2), with derivatives."""
    at = pose(Geometry(geometry.e, geometry.L, geometry.l, geometry.cd + complex(p[2], p[3])), theta + p[:2])
    by_joint = distance_by_joint(at)
    jacobian = np.empty((len(at.rho), 5))
    jacobian[:, :2] = by_joint
    jacobian[:, 2] = -at.direction.real
    jacobian[:, 3] = -at.direction.imag
    jacobian[:, 4] = -1.0
    return Observation(at.rho - p[4], jacobian, by_joint)
