"""The expected position error over the workspace, before and after a calibration."""

from __future__ import annotations

from station.records.record import Record

Grid = tuple[tuple[float | None, ...], ...]
"""One row for each y, one value for each x; null where the robot cannot move."""


class FreshReading(Record):
    """A reading that was not used in the fit."""

    reading: int
    x_mm: float
    """Position of the platform by the identified model."""
    y_mm: float
    residual_mm: float
    """Measured less predicted distance."""


class ErrorMap(Record):
    """Errors over a grid of the workspace, with commands computed from the nominal geometry."""

    x_mm: tuple[float, ...]
    y_mm: tuple[float, ...]
    before_mm: Grid
    """Expected position error with the previous zeros of the drives: the root of its mean square."""
    after_mm: Grid
    """The same with the identified zero offsets in the drives."""
    after_95_mm: Grid
    """With 95 % probability the position error there is not larger; the maximum is `bound_95_mm`."""
    bound_95_mm: float
    """With 95 % probability no position error over the workspace is larger."""
    limit_mm: float | None
    """Required accuracy: largest position error; null if not specified."""
    fresh: tuple[FreshReading, ...]
    """Readings that verified the result; empty if each reading was predicted before it was used."""
