"""The error maps as rectangles of one colour scale, for HTML and PDF alike.

The colours go from dark to light in even steps of lightness (Viridis), so that they are distinguishable in
grey and by colour-blind readers; classes are evenly spaced in the logarithm, since before and after may
differ a hundredfold.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from station.records import ErrorMap, Real

COLOURS = (
    "#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c", "#22a884", "#44bf70", "#7ad151",
    "#bddf26", "#fde725",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Cell:
    """A rectangle of one colour; all coordinates between 0 and 1, y upward."""

    x: float
    y: float
    width: float
    height: float
    colour: str


@dataclass(frozen=True, slots=True)
class Drawing:
    """Three maps on one scale."""

    aspect: float
    """Height over width."""
    before: tuple[Cell, ...]
    after: tuple[Cell, ...]
    bound: tuple[Cell, ...]
    fresh: tuple[tuple[float, float], ...]
    """Positions of fresh readings, between 0 and 1."""
    edges_mm: tuple[float, ...]
    """Edges of the classes, one more than there are colours."""

    @property
    def maps(self) -> tuple[tuple[Cell, ...], ...]:
        """Maps in the order in which they are shown."""
        return self.before, self.after, self.bound


def drawing_of(errors: ErrorMap) -> Drawing | None:
    """The drawing; None if the map has no value to draw."""
    grids = [_array(grid) for grid in (errors.before_mm, errors.after_mm, errors.after_95_mm)]
    values = np.concatenate([grid[np.isfinite(grid) & (grid > 0)] for grid in grids])
    if not len(values):
        return None
    low, high = float(values.min()), float(values.max())
    edges = np.geomspace(low, max(high, low * 1.01), len(COLOURS) + 1)
    before, after, bound = (tuple(_cells(grid, edges)) for grid in grids)
    width, height = (axis[-1] - axis[0] or 1.0 for axis in (errors.x_mm, errors.y_mm))
    return Drawing(
        aspect=height / width,
        before=before,
        after=after,
        bound=bound,
        fresh=tuple(
            ((one.x_mm - errors.x_mm[0]) / width, (one.y_mm - errors.y_mm[0]) / height)
            for one in errors.fresh
        ),
        edges_mm=tuple(float(edge) for edge in edges),
    )


def significant(value_mm: float) -> int:
    """Number of decimals for two significant digits."""
    return max(0, 1 - math.floor(math.log10(value_mm))) if value_mm > 0 else 0


def _array(grid: tuple[tuple[float | None, ...], ...]) -> Real:
    return np.array([[np.nan if v is None else v for v in row] for row in grid])


def _cells(grid: Real, edges: Real) -> Iterator[Cell]:
    """Neighbours of one colour in a row are one rectangle."""
    rows, columns = grid.shape
    last = len(COLOURS) - 1
    for row in range(rows):
        classes = [
            None if math.isnan(value) else min(max(int(np.searchsorted(edges, value, "right")) - 1, 0), last)
            for value in grid[row]
        ]
        first = 0
        while first < columns:
            end = first
            while end < columns and classes[end] == classes[first]:
                end += 1
            if (here := classes[first]) is not None:
                yield Cell(
                    x=first / columns,
                    y=row / rows,
                    width=(end - first) / columns,
                    height=1 / rows,
                    colour=COLOURS[here],
                )
            first = end
