"""What a run ends with: its numbers, its verdict and the reason of it."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field

from station.records.accuracy import AccuracyReached, Advice, PositionError, WeakDirection
from station.records.diagnosis_document import DiagnosisDocument, Finding
from station.records.quantity import Quantity
from station.records.reason import Reason
from station.records.record import Record
from station.records.references import MountingError, ReferenceUse

Verdict = Literal["pass", "fail"]
Outcome = Literal[
    "good",
    "repair",
    "ambiguous",
    "unexplained",
    "not_accurate_enough",
    "not_verified",
    "failed",
    "aborted",
    "interrupted",
]
"""What the robot's owner has to do: use it, repair it, decide, look further, measure again."""


class ZeroOffset(Record):
    """Actual minus nominal angle of one joint."""

    joint: int
    value_deg: float | None = None
    sd_deg: float | None = None


class Accuracy(Record):
    """How well the robot positions, before or after; of a diagnosis, without its effects or with them."""

    reading_rms_mm: float | None = None
    fresh_reading_rms_mm: float | None = None
    """Of readings that took no part in the fit."""
    fresh_reading_max_mm: float | None = None
    predicted_position_error_mm: PositionError | None = None


class Residual(Record):
    """Measured less predicted, of one reading."""

    reading: int
    position: str | None = None
    residual_mm: float | None = None
    limit_mm: float | None = None


class Iteration(Record):
    """One pass of measuring and solving (eq. 29 to 33)."""

    number: Annotated[int, Field(alias="pass")]
    dtheta1_deg: float | None = None
    dtheta2_deg: float | None = None
    total1_deg: float | None = None
    total2_deg: float | None = None
    mu_deg: float | None = None
    condition: float | None = None


class MemoryUse(Record):
    """Whether what earlier runs know of geometry and mechanism took part."""

    used: bool
    p_value: float | None = None
    """Of the readings under the memory."""
    text: str
    from_calibration: int
    age_days: float | None = None


class FleetPrior(Record):
    """Geometry of a robot as others of its type let expect it, before it is measured: mm and mm^2."""

    type: str
    """As the robot files name it."""
    serials: tuple[str, ...]
    """Of those others."""
    names: tuple[str, ...]
    mean: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]

    @property
    def age_days(self) -> float:
        """It is made when a run begins."""
        return 0.0


class FleetUse(Record):
    """Whether what other robots of the type showed took part."""

    used: bool
    p_value: float | None = None
    """Of the readings under that prior."""
    text: str
    prior: FleetPrior


class CheckFound(Record):
    """How small a shift of the zeros a check would have found, and what it found."""

    smallest_shift_deg: float
    """A shift of either zero of this size is found with 99 % probability."""
    smallest_by_joint_deg: tuple[float, float]
    shift_deg: tuple[float, float]
    """The shift of each zero that explains the readings best."""
    p_value: float
    """Of the readings, if nothing has changed."""
    blind: str
    """The direction of both zeros together in which a shift shows least."""
    blind_shift_deg: float
    """The shift that is found along it."""
    valid_until: datetime | None = None
    """Until when the check holds; null when it failed."""


class LastingParameters(Record):
    """What a pass leaves to the robot's next run: geometry and mechanism, mm and mm^2."""

    names: tuple[str, ...]
    mean: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]
    references: tuple[MountingError, ...] = ()
    """Measurements of the mounting that took part."""
    noise_ratio: float = 1.0
    """Noise of a reading over its specification, as repeats showed it."""
    fleet: FleetPrior | None = None
    """What other robots had told before this one was measured first; null for its tolerances alone."""


class ResultParts(Record):
    """What is kept of a result beside its verdict and zero offsets."""

    method: str | None = None
    parameters: tuple[Quantity, ...] = ()
    """Every identified parameter but the zero offsets."""
    weak_direction: WeakDirection | None = None
    before: Accuracy | None = None
    """With no compensation."""
    after: Accuracy | None = None
    """With the identified offsets applied."""
    accuracy: AccuracyReached | None = None
    """What is promised of positions, beside what was wanted; null where no offsets were identified."""
    advice: tuple[Advice, ...] = ()
    """What would help most, by gain per minute; only what helps."""
    check: CheckFound | None = None
    """Of a check."""
    iterations: tuple[Iteration, ...] = ()
    residuals: tuple[Residual, ...] = ()
    """Of the readings of the fit."""
    memory: MemoryUse | None = None
    """Null when nothing was known of this robot before."""
    fleet: FleetUse | None = None
    """Null when this robot was known, or no others of its type were."""
    references: tuple[ReferenceUse, ...] = ()
    """What other instruments measured, and how well it agrees with the rest."""
    lack_of_fit: str | None = None
    """What the model does not account for; null when it fits or none was judged."""
    findings: tuple[Finding, ...] = ()
    """Effects that the model lacked, strongest first."""


class CalibrationResult(ResultParts):
    """What a run ends with.  `verdict` is "pass" only when every check passed on finite numbers."""

    verdict: Verdict
    outcome: Outcome
    reason: Reason
    zero_offsets: tuple[Quantity, ...]
    """dtheta1, dtheta2 in deg."""
    lasting: LastingParameters | None = None
    diagnosis: DiagnosisDocument | None = None
    """The whole document; None when none was asked for."""
