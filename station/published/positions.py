"""The positions to measure (paper section 5, eq. 31 and Fig. 7)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.five_bar import Robot, inverse
from station.published.method import boundary_positions, identification_matrix

EPSILON_0 = 0.01
"""Threshold of eq. 31 (section 6.1)."""


@dataclass(frozen=True, slots=True)
class Conditioning:
    """One row of Fig. 8."""

    n: int
    kappa_1: float
    kappa_m: float

    @property
    def epsilon(self) -> float:
        """Relative difference of eq. 31."""
        return abs(self.kappa_1 - self.kappa_m) / self.kappa_1


def conditioning(robot: Robot, n: int) -> Conditioning:
    """kappa_1 of the first identification and kappa_m of the later ones, with the expected MAEMM (eq. 31)."""
    theta = inverse(robot.geometry, boundary_positions(robot.workspace_x, robot.workspace_y, n))
    first = identification_matrix(robot.geometry, theta)
    later = identification_matrix(robot.geometry, theta, complex(*robot.drm))
    return Conditioning(n, float(np.linalg.cond(first)), float(np.linalg.cond(later)))


def positions_per_edge(robot: Robot, largest: int = 20) -> int:
    """The smallest n >= 3 with epsilon <= epsilon_0 (eq. 31)."""
    for n in range(3, largest):
        if conditioning(robot, n).epsilon <= EPSILON_0:
            return n
    return largest
