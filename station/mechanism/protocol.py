"""The interface of a machine for identification and diagnosis.

A mechanism computes the measured quantities from joint angles and parameters, with derivatives. Rows are
single numbers: a distance is one row per reading, a tracker position three.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from station.mechanism.observation import Observation, Parameter
from station.records import Complex, Measurements, Real

if TYPE_CHECKING:
    from station.mechanism.conditions import Conditions, Reference


class Mechanism(Protocol):
    """The machine with its measuring mechanism, for one set of readings."""

    @property
    def model(self) -> str:
        """Kind of machine: `model` of its robot file."""
        ...

    @property
    def measurements(self) -> Measurements:
        """The readings."""
        ...

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """All unknowns, in the order of p; the zero offsets of the joints come first."""
        ...

    @property
    def start(self) -> Real:
        """(P,) start of a fit."""
        ...

    @property
    def needs_repeats(self) -> bool:
        """Whether only repeats can judge a residual; otherwise the specification is sufficient."""
        ...

    @property
    def simplest(self) -> tuple[str, tuple[str, ...]]:
        """The simplest model of this machine: its name, and the parameters that are free in it."""
        ...

    @property
    def measured(self) -> Real:
        """(R,) measured values, mm."""
        ...

    @property
    def reading_of_row(self) -> NDArray[np.intp]:
        """(R,) index of the reading each row belongs to; rows of one reading are adjacent."""
        ...

    @property
    def theta(self) -> Real:
        """(K, n) joint angles of the readings, rad."""
        ...

    @property
    def row_sd(self) -> Real:
        """(R,) standard deviation by specification, mm: instrument, and unresolved feedback."""
        ...

    def of(self, measurements: Measurements) -> Self:
        """The same machine with other readings."""
        ...

    def check(self) -> None:
        """:raises InputRefused: readings are impossible for this machine, by reading and column."""
        ...

    def observe(self, p: Real, theta: Real) -> Observation:
        """Predict all rows at parameters p (P,) and joint angles theta (K, n); NaN for impossible poses."""
        ...

    def conditions(self, p: Real, reference: Reference, *, first: bool) -> Conditions:
        """The conditions of the readings, at p; `first` when the model is being learned from them."""
        ...

    def implausible(self, p: Real) -> str:
        """Why parameters p (P,) are impossible for a calibrated machine; empty when they are possible."""
        ...

    @property
    def workspace(self) -> Complex:
        """(G,) positions at which position errors are predicted, mm; none where no workspace is declared."""
        ...

    def position_errors(self, p: Real) -> tuple[Real, Real] | None:
        """Errors (G, 2) at the workspace's positions, mm, at parameters p under nominal commands.

        Also their derivative (G, 2, P). None where no workspace is declared.
        """
        ...

    def places(self, p: Real) -> Real:
        """(K, d) mm, position of the end of the machine at each reading."""
        ...


def by_reading(mechanism: Mechanism, rows: Real) -> Real:
    """(K,) length of each reading's error from its rows (R,), over all coordinates."""
    return np.sqrt(np.bincount(mechanism.reading_of_row, rows**2))


def axis_of_row(mechanism: Mechanism) -> NDArray[np.intp]:
    """(R,) index of the coordinate of each row."""
    return axes(mechanism.reading_of_row)


def axes(reading: NDArray[np.intp]) -> NDArray[np.intp]:
    """(R,) the same from the ascending numbers of the readings (R,)."""
    return np.asarray(np.arange(len(reading)) - np.searchsorted(reading, reading))
