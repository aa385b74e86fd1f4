"""How well zero offsets and positions are known."""

from __future__ import annotations

from station.records.record import Record


class PositionError(Record):
    """Over the workspace or the measured poses, mm."""

    rms: float
    max: float
    bound_95: float | None = None
    """With 95 % probability no error is larger; null where only one model was considered."""


class Remedy(Record):
    """What would determine a weak direction, and the standard uncertainty of the zero offsets with it."""

    text: str
    sd_deg: float


class WeakDirection(Record):
    """The direction of the zero offsets that the readings determine least."""

    singular_ratio: float | None = None
    text: str = ""
    sd_deg: float | None = None
    """Standard uncertainty of the zero offsets along it."""
    blind: tuple[str, ...] = ()
    """Directions that no reading can see."""
    remedies: tuple[Remedy, ...] = ()
    remedy: str | None = None
    """The best of them in words."""
