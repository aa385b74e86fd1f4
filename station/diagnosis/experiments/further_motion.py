"""Further motion: readings at which the explanations differ most, relative to noise and uncertainty."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from station.diagnosis.experiments.asking import asked, outcome
from station.diagnosis.experiments.in_question import Hypothesis
from station.diagnosis.experiments.outcomes import Outcome
from station.diagnosis.explanations import ExplanationSet
from station.diagnosis.search import ALIAS
from station.plans import SIDES
from station.records import Complex, Real

PLACES = (17, 9)
INSET_MM = 4.0
"""Distance from the workspace's edge that is kept free for the run-up."""
WORTH, APART = 2.0 * ALIAS, 4.0
"""Expected chi-square between two explanations: enough to decide, and worth mentioning."""


@dataclass(frozen=True)
class Motion:
    """Chosen readings."""

    places: Complex
    """(N,) mm, nearest first."""
    sides: Real
    """(N, 2)"""
    outcomes: tuple[Outcome, ...]
    """The prediction of each explanation."""
    apart: tuple[int, ...]
    """Numbers of the explanations that they should distinguish from the first."""


def motion(
    found: ExplanationSet, some: Sequence[Hypothesis], count: int, grid: tuple[int, int] = PLACES
) -> Motion:
    """The best selection of this many readings, chosen one after another."""
    places, sides = _candidates(found, grid)
    mechanism = found.mechanism.of(asked(found, places, sides, count))
    said = [outcome(found, mechanism, one) for one in some]
    disputes = {k: _Dispute.between(said[0], said[k]) for k in range(1, len(some))}
    chosen: list[int] = []
    for _ in range(count):
        # for the pair that one more reading advances most, as long as any is undecided
        still = [d for d in disputes.values() if d.expected < WORTH] or list(disputes.values())
        best = int(np.argmax(max(still, key=lambda d: float(d.gain.max())).gain))
        chosen.append(best)
        disputes = {k: d.after(best) for k, d in disputes.items()}
    way = _nearest_first(places, chosen)
    apart = tuple(k for k, d in disputes.items() if d.expected >= APART)
    return Motion(places[way], sides[way], tuple(o.take(way) for o in said), apart)


def _candidates(found: ExplanationSet, grid: tuple[int, int]) -> tuple[Complex, Real]:
    """(K,) positions of the workspace and (K, 2) senses of approach there."""
    robot = found.mechanism.robot
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + INSET_MM, x1 - INSET_MM, grid[0])
    y = np.linspace(y0 + INSET_MM, y1 - INSET_MM, grid[1])
    places = (x[None, :] + 1j * y[:, None]).ravel()
    return np.repeat(places, len(SIDES)), np.tile(np.array(SIDES, dtype=float), (len(places), 1))


@dataclass(frozen=True)
class _Dispute:
    """Two explanations over the candidates, given the stops chosen so far."""

    difference: Real
    """(K,) difference of their predictions, less the part that the chosen stops already determine."""
    root: Real
    """(K, X) root of the covariance of what both leave uncertain, without noise."""
    noise: Real
    """(K,) variance of a reading."""
    expected: float = 0.0
    """Chi-square between the two that is expected from the chosen stops."""

    @classmethod
    def between(cls, one: Outcome, other: Outcome) -> Self:
        return cls(other.mean - one.mean, np.hstack([one.root, other.root]), one.noise)

    @cached_property
    def gain(self) -> Real:
        """(K,) chi-square that one more reading at each candidate adds."""
        return np.asarray(self.difference**2 / (np.sum(self.root**2, axis=1) + self.noise))

    def after(self, k: int) -> Self:
        """With candidate k read: 1 - v v' / (v'v + noise) is the square of 1 - share v v' / v'v."""
        v = self.root[k]
        known, variance = float(v @ v), float(v @ v + self.noise[k])
        along = self.root @ v
        share = (1.0 - np.sqrt(self.noise[k] / variance)) / max(known, 1e-300)
        return replace(
            self,
            difference=self.difference - along / variance * self.difference[k],
            root=self.root - share * np.outer(along, v),
            expected=self.expected + float(self.gain[k]),
        )


def _nearest_first(places: Complex, chosen: list[int]) -> list[int]:
    """A path that always goes to the nearest remaining position; repeats follow each other."""
    left = sorted(chosen)
    way = [left.pop(0)]
    while left:
        way.append(left.pop(int(np.argmin(np.abs(places[left] - places[way[-1]])))))
    return way
