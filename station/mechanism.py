"""What identification and diagnosis need to know of a machine, and nothing else.

A mechanism turns joint angles and parameters into what is measured, with derivatives.  Rows are
single numbers: a distance is one row a reading, a tracker position two or three.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from station.kinematics import Real


@dataclass(frozen=True, slots=True)
class Parameter:
    """One unknown.  Value and prior are in mm or rad; `shown` times that is in `unit`."""

    name: str
    unit: str
    prior_mean: float
    prior_sd: float
    """Standard deviation of what is known beforehand; inf when nothing is."""
    shown: float = 1.0


class Observation(NamedTuple):
    """What the machine would show: R rows for P parameters and n joints."""

    value: Real
    """(R,) mm."""
    by_parameter: Real
    """(R, P)"""
    by_joint: Real
    """(R, n) mm/rad"""


class Mechanism(Protocol):
    """The machine with its measuring mechanism, for one set of readings."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """All unknowns, in the order of p."""
        ...

    @property
    def measured(self) -> Real:
        """(R,) what was measured, mm."""
        ...

    @property
    def reading_of_row(self) -> NDArray[np.intp]:
        """(R,) index of the reading each row belongs to."""
        ...

    @property
    def theta(self) -> Real:
        """(K, n) joint angles of the readings, rad."""
        ...

    @property
    def row_sd(self) -> Real:
        """(R,) standard deviation by specification, mm: head, and what feedback leaves of the joints."""
        ...

    def observe(self, p: Real, theta: Real) -> Observation:
        """Predict all rows at parameters p (P,) and joint angles theta (K, n); NaN where it cannot be."""
        ...

    def position_errors(self, p: Real) -> tuple[Real, Real]:
        """Over the workspace: position at p less the commanded one (G, dim), and its Jacobian (G, dim, P)."""
        ...
