"""How well zero offsets and positions are known."""

from __future__ import annotations

import math

from station.records.record import Record


class PositionError(Record):
    """Over the workspace or the measured poses, mm."""

    rms: float
    max: float
    bound_95: float | None = None
    """With 95 % probability no error is larger; null where only one model was considered."""


class AccuracyReached(Record):
    """What a calibration promises of positions, beside what was wanted."""

    bound_95_mm: float | None = None
    """With 95 % probability no position error over the workspace is larger, with the zeros in the drives
    only: what the robot's own controller will do."""
    bound_95_model_mm: float | None = None
    """The same with joint commands computed from the identified model."""
    wanted_mm: float | None = None
    """Null where nobody said."""
    reached: bool | None = None
    """Whether `bound_95_mm` is what was wanted; null without a wish."""
    stopped_because: str | None = None
    """Why no further readings were taken."""

    @classmethod
    def of(
        cls, by_drives_mm: float | None, by_model_mm: float | None, wanted_mm: float | None, stopped: str
    ) -> AccuracyReached:
        """A bound that is no finite number is none, and meets no wish."""
        finite_mm = by_drives_mm if by_drives_mm is not None and math.isfinite(by_drives_mm) else None
        model_mm = by_model_mm if by_model_mm is not None and math.isfinite(by_model_mm) else None
        reached = None if wanted_mm is None else finite_mm is not None and finite_mm <= wanted_mm
        return cls(
            bound_95_mm=finite_mm,
            bound_95_model_mm=model_mm,
            wanted_mm=wanted_mm,
            reached=reached,
            stopped_because=stopped,
        )


class Advice(Record):
    """What would make a calibration better."""

    kind: str
    """`repeat`, `joint_angle`, `drm_x` or `second_mount`."""
    text: str
    joint: int | None = None
    """Of a joint angle: whose."""
    gain_mm: float
    """By how much the bound on the largest position error would fall, with the zeros in the drives only."""
    minutes: float


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
