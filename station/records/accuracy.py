"""The accuracy of zero offsets and positions."""

from __future__ import annotations

import math

from station.records.phrases import Phrase
from station.records.record import Record


class PositionError(Record):
    """Position error over the workspace or the measured poses, mm."""

    rms: float
    max: float
    bound_95: float | None = None
    """With 95 % probability no error is larger; null if only one model was considered."""


class AccuracyReached(Record):
    """The predicted position accuracy of a calibration, with the required one."""

    bound_95_mm: float | None = None
    """With 95 % probability no position error over the workspace is larger, with the zeros in the drives
    only, as with the robot's own controller.
    """
    bound_95_model_mm: float | None = None
    """The same with joint commands computed from the identified model."""
    wanted_mm: float | None = None
    """Required accuracy; null if not specified."""
    reached: bool | None = None
    """Whether `bound_95_mm` meets the requirement; null without one."""
    stopped_because: str | None = None
    """Why no further readings were taken."""
    stopped_because_said: Phrase | None = None
    """The same by its code, for other languages; null in results of older versions, too."""

    @classmethod
    def of(
        cls, by_drives_mm: float | None, by_model_mm: float | None, wanted_mm: float | None, stopped: Phrase
    ) -> AccuracyReached:
        """A bound that is not finite becomes null and meets no requirement."""
        finite_mm = by_drives_mm if by_drives_mm is not None and math.isfinite(by_drives_mm) else None
        model_mm = by_model_mm if by_model_mm is not None and math.isfinite(by_model_mm) else None
        reached = None if wanted_mm is None else finite_mm is not None and finite_mm <= wanted_mm
        return cls(
            bound_95_mm=finite_mm,
            bound_95_model_mm=model_mm,
            wanted_mm=wanted_mm,
            reached=reached,
            stopped_because=stopped.text(),
            stopped_because_said=stopped,
        )


class Advice(Record):
    """A measure that would improve a calibration."""

    kind: str
    """`repeat`, `joint_angle`, `drm_x` or `second_mount`."""
    text: str
    joint: int | None = None
    """The joint, if `kind` is `joint_angle`."""
    gain_mm: float
    """Reduction of the bound on the largest position error, with the zeros in the drives only."""
    minutes: float


class Remedy(Record):
    """A measurement that would determine a weak direction, and the zero offsets' standard uncertainty."""

    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null in documents of older versions."""
    sd_deg: float


class WeakDirection(Record):
    """The direction of the zero offsets that the readings determine least."""

    singular_ratio: float | None = None
    text: str = ""
    said: Phrase | None = None
    """The text by its code, for other languages; null in documents of older versions."""
    sd_deg: float | None = None
    """Standard uncertainty of the zero offsets along it."""
    blind: tuple[str, ...] = ()
    """Directions that no reading can determine."""
    blind_said: tuple[Phrase, ...] = ()
    """The same by their codes."""
    remedies: tuple[Remedy, ...] = ()
    remedy: str | None = None
    """The best of them in words."""
    remedy_said: Phrase | None = None
    """The same by its code."""
