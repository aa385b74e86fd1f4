"""The residuals of a result, one row per reading."""

from __future__ import annotations

from collections.abc import Iterable

from station.records.reading import Reading
from station.records.result import Residual
from station.records.types import Real

LIMIT_SDS = 3.5
"""A residual beyond this many standard deviations is marked."""


def residual_rows(readings: Iterable[Reading], residual_mm: Real, limit_mm: Real) -> tuple[Residual, ...]:
    """Residuals (K,) with their limits (K,), in the order of the readings."""
    return tuple(
        Residual(
            reading=reading.reading,
            position=reading.position,
            residual_mm=float(value),
            limit_mm=float(limit),
        )
        for reading, value, limit in zip(readings, residual_mm, limit_mm, strict=True)
    )
