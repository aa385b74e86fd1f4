"""Visited ranges of the joints: intervals in which readings are dense enough to determine a curve."""

from __future__ import annotations

import numpy as np

from station.records.types import Real

CELL_RAD = np.radians(5.0)
FEWEST = 3
"""Minimum number of readings in a cell."""

Stretches = list[tuple[float, float]]
"""Intervals of one joint, ascending, rad."""


def visited_ranges(theta: Real) -> list[Stretches]:
    """The intervals of each joint of theta (K, n), rad: neighbouring cells with readings are joined."""
    return [_stretches(angle) for angle in theta.T]


def _stretches(angle: Real) -> Stretches:
    cell = np.floor(angle / CELL_RAD).astype(int)
    number, count = np.unique(cell, return_counts=True)
    out: Stretches = []
    for k in number[count >= FEWEST]:
        low, high = float(k * CELL_RAD), float((k + 1) * CELL_RAD)
        if out and np.isclose(out[-1][1], low):
            out[-1] = (out[-1][0], high)
        else:
            out.append((low, high))
    return out


def inside_visited(theta: Real, stretches: list[Stretches]) -> np.ndarray:
    """(K,) whether all joints of theta (K, n) are within their visited ranges."""
    within = np.ones(len(theta), dtype=bool)
    for angle, own in zip(theta.T, stretches, strict=True):
        within &= np.any([(angle >= low) & (angle < high) for low, high in own], axis=0) if own else False
    return within


def visited_in_degrees(stretches: Stretches) -> Stretches:
    """The same in degrees."""
    return [(float(np.degrees(low)), float(np.degrees(high))) for low, high in stretches]
