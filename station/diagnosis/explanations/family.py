"""A family: one possible error of the machine; its members are searched and its sizes averaged."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from station.diagnosis.explanations.situation import TARGETS, Action, Situation
from station.records import Quantity, Real

Hidden = Mapping[str, float]
Quantities = Callable[[Hidden, Real, Real], tuple[Quantity, ...]]
"""Hidden parameters, amplitudes (q,) and their covariance (q, q) in the units of the catalogue."""
Shapes = Callable[[Situation], Real]
"""(K, q) course of an error over the readings, for a unit of each of its amplitudes."""
NODES = 6
"""Number of sizes of a family, evenly spaced in the logarithm."""


@dataclass(frozen=True)
class Part:
    """One effect of a family, its place of action, and its amplitudes."""

    effect: str
    """Identifier in the catalogue, or "unnamed"."""
    joint: int | None
    part: str | None
    """The part that it acts on: "L1", "links", "scale", ...; None where the joint is sufficient."""
    own: tuple[int, ...]
    """Indices into the family's amplitudes."""
    quantities: Quantities

    @property
    def key(self) -> tuple[str, int | None, str | None]:
        """Two explanations contain the same effect if this is equal."""
        return self.effect, self.joint, self.part


@dataclass(frozen=True)
class Family:
    """An error with V members of q amplitudes, each ~ N(0, size^2), size averaged over `sizes`."""

    kind: str
    """The mechanical cause in one word; it distinguishes unnamed families."""
    parts: tuple[Part, ...]
    weight: float
    """Share of the prior probability, relative to other families."""
    sizes: Real
    """(T,) prior standard deviations of the amplitudes, mm or rad per unit of the basis."""
    hidden: tuple[Hidden, ...]
    """(V) hidden parameters that distinguish the members."""
    actions: Callable[[Situation, Sequence[Hidden]], list[Action]]
    """The actions of members with these hidden parameters, for a unit of every amplitude."""
    depends_on: str | None = None
    """Dependence of an unnamed error: "joint1", "joint2", "reading", "place", "time" or "approach"."""
    signed: bool = False
    """Whether its only amplitude cannot be negative."""
    one_sided: bool = False
    """Whether none of its amplitudes can be negative; several amplitudes are checked after the fit."""
    neighbours: Callable[[Hidden, float], list[Hidden]] | None = None
    """Neighbours of given continuous hidden parameters, at a share of the search step."""
    repeats: bool = False
    """Whether the machine can have it more than once, with other hidden parameters."""

    width: int = 0
    """Number q of amplitudes; counted by `Bank`."""

    @property
    def named(self) -> bool:
        return self.depends_on is None

    @property
    def keys(self) -> frozenset[tuple[str, int | None, str | None]]:
        return frozenset(part.key for part in self.parts)

    def columns(self, s: Situation, member: int | None = None) -> Real:
        """(V, K * m, q) mm a unit of amplitude; of one member only, (1, K * m, q)."""
        return s.columns(self.actions(s, self._chosen(member)))

    def targets(self, s: Situation) -> frozenset[str]:
        """The targets that it acts on."""
        return frozenset(action.target for action in self.actions(s, self.hidden[:1]))

    def added(self, s: Situation, member: int, amplitudes: Real) -> Real:
        """(K, 13) contribution of one member with amplitudes (q,) to the targets."""
        out = np.zeros((len(s), len(TARGETS)))
        for target, basis in self.actions(s, self._chosen(member)):
            out[:, TARGETS.index(target)] += basis[0] @ amplitudes
        return out

    def _chosen(self, member: int | None) -> Sequence[Hidden]:
        return self.hidden if member is None else self.hidden[member : member + 1]


@cache
def sizes(low: float, high: float) -> Real:
    """(T,) sizes from `low` to `high`, evenly spaced in the logarithm."""
    out = np.geomspace(low, high, NODES)
    out.setflags(write=False)
    return out


def alone(basis: Real) -> Real:
    """(1, K, q) one member from its shapes (K,) or (K, q)."""
    return (basis[:, None] if basis.ndim == 1 else basis)[None]


def side_by_side(targets: Sequence[str], bases: Sequence[Real]) -> list[Action]:
    """Shapes with independent amplitudes on several targets: member by member, amplitudes in order."""
    total = sum(basis.shape[2] for basis in bases)
    out, first = [], 0
    for target, basis in zip(targets, bases, strict=True):
        wide = np.zeros((*basis.shape[:2], total))
        wide[:, :, first : first + basis.shape[2]] = basis
        first += basis.shape[2]
        out.append(Action(target, wide))
    return out


def scaled(name: str, factor: float, unit: str) -> Quantities:
    """One amplitude, times `factor` in `unit`."""

    def quantities(hidden: Hidden, amplitudes: Real, covariance: Real) -> tuple[Quantity, ...]:
        sd = float(np.sqrt(covariance[0, 0])) * abs(factor)
        return (Quantity(name, float(amplitudes[0]) * factor, sd, unit),)

    return quantities


def nothing(hidden: Hidden, amplitudes: Real, covariance: Real) -> tuple[Quantity, ...]:
    """An unnamed error has no parameters of its own; its size is its RMS over the readings."""
    return ()
