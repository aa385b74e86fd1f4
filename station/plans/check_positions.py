"""Plan `check`: four positions that best show a shift of either zero, and the smallest detectable shift."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
from scipy.special import chdtri, chndtrinc, fdtri, ncfdtrinc

from station.fitting import chance_of
from station.five_bar import Robot
from station.plans.full import inset_grid
from station.plans.plan import PlanDesign, Visits, each_once, register
from station.plans.prediction import information_rows, known_beforehand, measured_at
from station.records import Real

READINGS = 4
GRID = (5, 3)
SHIFT_P = 0.005
"""Probability that a correct machine fails because of an apparent shift,"""
REST_P = 0.002
"""and because of a residual that no shift explains."""
FOUND = 0.99
"""Probability with which the smallest shift is detected."""
FLAT_MM = 1e4
"""Prior of an unknown offset of the readout since the calibration."""


@dataclass(frozen=True)
class ShiftTest:
    """Whether readings are as predicted, and which shift of the two zeros explains it best if not.

    Generalised least squares: the readings less their prediction are A d + error with the shift d of the two
    zeros and the covariance of prediction and noise.
    """

    by_shift: Real
    """(R, 2) A, whitened, per rad."""
    covariance: Real
    """(R, R) of the whitened differences from the prediction, if nothing has shifted."""
    dof: int = 0
    """Degrees of freedom of the repeats that determined the noise; 0: it is as specified."""

    @property
    def information(self) -> Real:
        """(2, 2) information on the shift."""
        return np.asarray(self.by_shift.T @ np.linalg.solve(self.covariance, self.by_shift))

    def smallest(self) -> Real:
        """(2,) rad: shift of each joint alone that is detected with 99 % probability."""
        return np.asarray(np.sqrt(_needed(self.dof) / np.diag(self.information)))

    def blind(self) -> tuple[Real, float]:
        """The direction (2,) of both zeros with the smallest effect, and the shift detected along it."""
        values, vectors = np.linalg.eigh(self.information)
        return vectors[:, 0], float(np.sqrt(_needed(self.dof) / values[0]))

    def shift(self, difference: Real) -> tuple[Real, float, float]:
        """From whitened differences (R,): the shift (2,), p-value of no shift, p-value of the residual."""
        told = np.linalg.solve(self.covariance, np.column_stack([difference, self.by_shift]))
        square = float(difference @ told[:, 0])
        shift = np.linalg.solve(self.information, self.by_shift.T @ told[:, 0])
        explained = float(shift @ self.information @ shift)
        # one reading determines the offset of the readout
        left = len(difference) - 1 - len(shift)
        rest_p = chance_of(max(square - explained, 0.0), left, self.dof) if left > 0 else 1.0
        return shift, chance_of(explained, len(shift), self.dof), rest_p


@lru_cache(maxsize=64)
def _needed(dof: int) -> float:
    """Noncentrality that is detected with the stated probability."""
    if dof:
        return float(ncfdtrinc(2, dof, 1.0 - FOUND, float(fdtri(2, dof, 1.0 - SHIFT_P))))
    return float(chndtrinc(chdtri(2, SHIFT_P), 2, 1.0 - FOUND))


def four_positions(robot: Robot) -> Visits:
    """The positions of a coarse grid with the smallest detectable shift of the less visible joint."""
    places = inset_grid(robot, *GRID)
    mechanism = measured_at(robot, places)
    rows = information_rows(mechanism)
    covariance = np.linalg.inv(known_beforehand(mechanism) + rows.T @ rows)
    covariance[:, -1] = covariance[-1] = 0.0
    covariance[-1, -1] = FLAT_MM**2
    return each_once(places[list(_best(rows.tobytes(), covariance.tobytes(), len(places)))])


@lru_cache(maxsize=16)
def _best(rows: bytes, covariance: bytes, count: int) -> tuple[int, ...]:
    """The best of `count` candidates; cached."""
    whitened = np.frombuffer(rows).reshape(count, -1)
    known = np.frombuffer(covariance).reshape(whitened.shape[1], -1)
    fours = combinations(range(count), READINGS)
    return max(fours, key=lambda four: _shown(whitened[list(four)], known))


def _shown(rows: Real, covariance: Real) -> float:
    error = rows @ covariance @ rows.T + np.eye(len(rows))
    return float(np.diag(ShiftTest(rows[:, :2], error).information).min())


CHECK = register(PlanDesign("check", four_positions, run_kind="check"))
