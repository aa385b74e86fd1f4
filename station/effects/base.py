"""The definition of an effect: its place of action, its dependences, its form in a report.

An effect adds `basis @ amplitudes` to one thing: a joint angle (rad), the reading (mm), or lengths
(relative).  The basis depends on the conditions of each reading and on hidden parameters (a period, a moment)
that are searched; amplitudes are fitted.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from station.mechanism import Conditions, Observation
from station.records import Flags, Index, Motion, Phrase, Quantity, Real


@dataclass(frozen=True)
class Acts:
    """Where an effect acts: on joint (index), on lengths (parameter name: mm), on all joints along their
    motion, else on the reading.
    """

    joint: int | None = None
    lengths: Mapping[str, float] | None = None
    motion: Motion | None = None

    @property
    def turns(self) -> bool:
        """Whether it changes joint angles."""
        return self.joint is not None or self.motion is not None


ON_READING = Acts()
Bounds = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Variants:
    """V variants of an effect that differ only in hidden parameters."""

    acts: Acts
    basis: Real
    """(V, K, q)"""
    hidden: tuple[Mapping[str, float], ...]
    """(V) hidden parameters of each."""
    trials: float
    """Number of independent variants: the price of the search over them."""
    spread: Real | None = None
    """(q,) initial scatter of the amplitudes, where they are so many that they need a prior."""


def one(acts: Acts, basis: Real) -> Variants:
    """An effect without hidden parameters; basis (K, q) or (K,)."""
    columns = basis[:, None] if basis.ndim == 1 else basis
    return Variants(acts, columns[None], ({},), 1.0)


class Effect(ABC):
    """One entry of the catalogue, at one place of action on the machine."""

    id: ClassVar[str]
    physics: ClassVar[Phrase]
    """One sentence."""
    remedy: ClassVar[Phrase]
    experiment: ClassVar[Phrase]
    """The experiment that distinguishes it from its aliases."""
    repeats: ClassVar[bool] = False
    """Whether one place of action can have it more than once, with other hidden parameters."""
    by_approach: ClassVar[bool] = False
    """Whether its effect on the arm depends on the sense of the joint's last motion."""
    rare: ClassVar[bool] = False
    """Whether it is reported only where no other effect of its joint predicts left-out readings as well."""
    local: ClassVar[bool] = False
    """Whether it is undefined at angles that its joint has not visited."""
    bounds: ClassVar[Bounds] = {}
    """Physical limits: name of a quantity -> (least, most)."""
    covers: ClassVar[tuple[str, ...]] = ()
    """Effects of the same joint that are part of this one."""

    joint: int | None = None
    """1, 2, ... or None if the effect belongs to no joint."""

    @property
    def label(self) -> str:
        return f"{self.id} of joint {self.joint}" if self.joint else self.id

    @abstractmethod
    def variants(self, c: Conditions) -> Variants | None:
        """Its variants under these conditions; None if it cannot appear under them."""

    @abstractmethod
    def quantities(
        self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real
    ) -> tuple[Quantity, ...]:
        """Fitted amplitudes (q,) in the units of the catalogue, with sd."""

    def possible(self, hidden: Mapping[str, float], amplitudes: Real, covariance: Real) -> bool:
        """Whether every fitted quantity is physically possible, within two standard deviations."""
        for q in self.quantities(hidden, amplitudes, covariance):
            least, most = self.bounds.get(q.name, (-np.inf, np.inf))
            if not least <= q.value + 2.0 * q.sd or not q.value - 2.0 * q.sd <= most:
                return False
        return True

    def bands(self, size: int) -> Index:
        """(q,) band number of the amplitudes: equal for similar sizes; used only with a spread."""
        return np.zeros(size, dtype=np.intp)

    def refined(self, hidden: Mapping[str, float], c: Conditions) -> Mapping[str, tuple[float, float]]:
        """Hidden parameters that may be refined beyond the search grid: name -> (low, high)."""
        return {}

    def doubtful(self, c: Conditions) -> Flags:
        """(K,) readings under conditions in which its action is unknown."""
        return np.zeros(len(c), dtype=bool)

    def at(self, hidden: Mapping[str, float], c: Conditions) -> Real:
        """(K, q) basis at given hidden parameters under (other) conditions."""
        found = self.variants(c)
        if found is None:
            raise ValueError(f"{self.label} cannot be evaluated under these conditions")
        return np.asarray(found.basis[found.hidden.index(dict(hidden))])


class JointEffect(Effect):
    """An effect of one joint, or of the link or bearing that belongs to it."""

    joint: int

    def __init__(self, joint: int) -> None:
        self.joint = joint

    @property
    def index(self) -> int:
        """Index of its joint, from 0."""
        return self.joint - 1


def doubtful(effects: Iterable[Effect], c: Conditions) -> Flags:
    """(K,) readings for which the action of one of these effects is unknown."""
    mask = np.zeros(len(c), dtype=bool)
    for effect in effects:
        mask |= effect.doubtful(c)
    return mask


def weight(acts: Acts, at: Observation, names: tuple[str, ...]) -> Real:
    """(R,) effect of one unit of a basis on each row of a prediction, mm."""
    if acts.joint is not None:
        return at.by_joint[:, acts.joint]
    if acts.motion is not None:
        return np.asarray(np.sum(at.by_joint * at.motions[acts.motion], axis=1))
    if acts.lengths is not None:
        strain = sum(at.by_parameter[:, names.index(n)] * mm for n, mm in acts.lengths.items())
        return np.asarray(strain)
    return np.ones(len(at.value))


def signature(acts: Acts, basis: Real, at: Observation, names: tuple[str, ...], rows: Index) -> Real:
    """(..., R, q) effect of a basis (..., K, q) on the rows of a prediction; `rows` (R,) their reading."""
    return np.asarray(weight(acts, at, names)[:, None] * basis[..., rows, :])


def scaled(name: str, value: float, variance: float, factor: float, unit: str) -> Quantity:
    """A fitted amplitude as a quantity."""
    return Quantity(name, float(value * factor), float(np.sqrt(variance) * abs(factor)), unit)


def amplitude_and_phase(
    name: str, unit: str, factor: float, amplitudes: Real, covariance: Real
) -> tuple[Quantity, Quantity]:
    """The sum a cos x (first) + b sin x (second) as amplitude sin(x + phase)."""
    a, b = float(amplitudes[0]), float(amplitudes[1])
    size = float(np.hypot(a, b)) or 1e-300
    along = np.array([a, b]) / size
    across = np.array([b, -a]) / size**2
    return (
        scaled(name, size, float(along @ covariance @ along), factor, unit),
        scaled("phase_deg", np.arctan2(a, b), float(across @ covariance @ across), 180.0 / np.pi, "deg"),
    )
