"""Short paths through positions, and sweeps that decorrelate time and position.

Both joints move together, so a path is as long as that of the joint with the longer motion (Chebyshev
distance).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from station.plans.duration import USUAL
from station.records import Index, Real

ROUNDS = 30
TOURS = 24
"""Number of different short paths from which sweeps are combined."""
TRIED = 800
"""Number of combinations tried."""
SPARE = 1.04
"""Share of the shortest duration that may be spent on decorrelating time and position."""


def short_ways(theta_deg: Real, count: int, rng: np.random.Generator) -> list[Index]:
    """`count` short paths (K,) through positions (K, 2), from different starts: nearest first, then improved
    by reversing sections and by moving single positions (2-opt, Or-opt).
    """
    apart = np.abs(theta_deg[:, None] - theta_deg[None, :]).max(axis=2)
    starts = rng.permutation(len(theta_deg))
    return [_improved(_nearest_first(apart, int(starts[k % len(starts)])), apart) for k in range(count)]


def _nearest_first(apart: Real, start: int) -> list[int]:
    way, left = [start], set(range(len(apart))) - {start}
    while left:
        way.append(min(left, key=lambda k: apart[way[-1], k]))
        left.remove(way[-1])
    return way


def _improved(way: list[int], apart: Real) -> Index:
    """Whether no reversed section and no moved position makes it shorter; ends are free."""

    def length(order: Sequence[int]) -> float:
        index = np.asarray(order)
        return float(apart[index[:-1], index[1:]].sum())

    best, shortest = way, length(way)
    for _ in range(ROUNDS):
        before = shortest
        for i in range(len(way)):
            for j in range(i + 1, len(way)):
                turned = best[:i] + best[i : j + 1][::-1] + best[j + 1 :]
                moved = best[:i] + best[i + 1 : j + 1] + [best[i]] + best[j + 1 :]
                for other in (turned, moved):
                    if (its := length(other)) < shortest - 1e-9:
                        best, shortest = other, its
        if shortest == before:
            break
    return np.array(best)


@dataclass(frozen=True)
class Sweeps:
    """Visits (R,) of positions and the requested approach (R, 2) of each."""

    order: Index
    approach: Index


def sweeps(theta_deg: Real, sides: Index) -> Sweeps:
    """As `_sweeps`, which takes a second; results are cached."""
    return _sweeps(theta_deg.tobytes(), sides.tobytes(), sides.shape)


@lru_cache(maxsize=16)
def _sweeps(theta: bytes, side: bytes, shape: tuple[int, int, int]) -> Sweeps:
    """Every position once per sweep, in short paths whose directions vary.

    theta_deg (K, 2) commands, sides (S, K, 2) the approach of position k in one of the sweeps; their order is
    free. Among many combinations of sweeps, those within a few percent of the shortest duration are
    considered, and the one whose time correlates least with position and approach is chosen. The result is
    always the same.
    """
    theta_deg, sides = np.frombuffer(theta).reshape(-1, 2), np.frombuffer(side, dtype=np.intp).reshape(shape)
    rng = np.random.default_rng(0)
    ways = short_ways(theta_deg, TOURS, rng)
    tried: list[tuple[float, float, Sweeps]] = []
    for _ in range(TRIED):
        chosen = [ways[k] for k in rng.integers(len(ways), size=len(sides))]
        turned = [
            way[::-1] if back else way for way, back in zip(chosen, rng.random(len(sides)) < 0.5, strict=True)
        ]
        dealt = rng.permuted(np.tile(np.arange(len(sides)), (len(theta_deg), 1)), axis=1)
        found = Sweeps(
            np.concatenate(turned),
            np.concatenate([sides[dealt[way, s], way] for s, way in enumerate(turned)]),
        )
        duration_s = USUAL.along(theta_deg[found.order], found.approach)[1]
        tried.append((float(duration_s.sum()), time_told(theta_deg, found, duration_s), found))
    limit = SPARE * min(duration_s for duration_s, _, _ in tried)
    return min((t for t in tried if t[0] <= limit), key=lambda t: t[1])[2]


def time_told(theta_deg: Real, found: Sweeps, duration_s: Real) -> float:
    """Largest correlation of time and its square with position, its squares and approach."""
    x, y = theta_deg[found.order].T
    what = np.column_stack([x, y, x * x, x * y, y * y, found.approach])
    time = np.cumsum(duration_s)
    time = 2.0 * (time - time.min()) / np.ptp(time) - 1.0
    when = np.column_stack([time, time**2])
    what, when = (_standard(columns) for columns in (what, when))
    return float(np.abs(when.T @ what).max()) / len(time)


def _standard(columns: Real) -> Real:
    columns = columns - columns.mean(axis=0)
    return np.asarray(columns / np.maximum(columns.std(axis=0), 1e-12))
