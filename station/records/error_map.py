"""The expected position error over the workspace, before and after a calibration."""

from __future__ import annotations

from station.records.record import Record

Grid = tuple[tuple[float | None, ...], ...]
"""One row for each y, one value for each x; null where the robot cannot be sent."""


class FreshReading(Record):
    """A reading that took no part in the fit."""

    reading: int
    x_mm: float
    """Where the platform stood, by the model as identified."""
    y_mm: float
    residual_mm: float
    """Measured less predicted distance."""


class ErrorMap(Record):
    """Over a grid of the workspace, with commands computed from the nominal geometry."""

    x_mm: tuple[float, ...]
    y_mm: tuple[float, ...]
    before_mm: Grid
    """Expected position error with the zeros that the drives had: the root of its mean square."""
    after_mm: Grid
    """The same with the identified zero offsets in the drives."""
    after_95_mm: Grid
    """With 95 % probability the position error there is not larger; its largest value is `bound_95_mm`."""
    bound_95_mm: float
    """With 95 % probability no position error over the workspace is larger."""
    limit_mm: float | None
    """Largest position error that was wanted; null where nobody said."""
    fresh: tuple[FreshReading, ...]
    """Readings that verified the result; empty where each reading was predicted before it was used."""
