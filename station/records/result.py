"""The result of a run: its numbers, its verdict and the reason for it."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field

from station.records.accuracy import AccuracyReached, Advice, PositionError, WeakDirection
from station.records.diagnosis_document import DiagnosisDocument, Finding
from station.records.phrases import Phrase
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
"""Next action for the robot's owner: use it, repair it, decide, investigate further, measure again."""


class ZeroOffset(Record):
    """Actual minus nominal angle of one joint."""

    joint: int
    value_deg: float | None = None
    sd_deg: float | None = None


class Accuracy(Record):
    """Position accuracy of the robot, before or after; for a diagnosis, without its effects or with them."""

    reading_rms_mm: float | None = None
    fresh_reading_rms_mm: float | None = None
    """RMS of readings that were not used in the fit."""
    fresh_reading_max_mm: float | None = None
    predicted_position_error_mm: PositionError | None = None


class Residual(Record):
    """Residual of one reading: measured less predicted."""

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
    """Whether the knowledge of geometry and mechanism from earlier runs was used."""

    used: bool
    p_value: float | None = None
    """p-value of the readings under the memory."""
    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null in records of older versions."""
    from_calibration: int
    age_days: float | None = None


class FleetPrior(Record):
    """Expected geometry of a robot from others of its type, before it is measured: mm and mm^2."""

    type: str
    """Type as in the robot files."""
    serials: tuple[str, ...]
    """Serials of those others."""
    names: tuple[str, ...]
    mean: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]

    @property
    def age_days(self) -> float:
        """Age; the prior is made when a run begins."""
        return 0.0


class FleetUse(Record):
    """Whether the prior from other robots of the type was used."""

    used: bool
    p_value: float | None = None
    """p-value of the readings under that prior."""
    text: str
    prior: FleetPrior


class CheckFound(Record):
    """The smallest shift of the zeros that a check detects, and the shift found."""

    smallest_shift_deg: float
    """A shift of either zero of this size is detected with 99 % probability."""
    smallest_by_joint_deg: tuple[float, float]
    shift_deg: tuple[float, float]
    """The shift of each zero that explains the readings best."""
    p_value: float
    """p-value of the readings, if nothing has changed."""
    blind: str
    """The direction of both zeros together in which a shift has the smallest effect."""
    blind_shift_deg: float
    """The smallest shift detected along it."""
    valid_until: datetime | None = None
    """End of the check's validity; null if it failed."""
    known_by: int | None = None
    """The newer calibration that has found this shift and is not applied; null if there is none."""


class LastingParameters(Record):
    """Data that a pass leaves to the robot's next run: geometry and mechanism, mm and mm^2."""

    names: tuple[str, ...]
    mean: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]
    references: tuple[MountingError, ...] = ()
    """Measurements of the mounting that were used."""
    noise_ratio: float = 1.0
    """Noise of a reading over its specification, from the repeats."""
    fleet: FleetPrior | None = None
    """Prior from other robots before this one was first measured; null if only its tolerances were used."""


class ResultParts(Record):
    """Stored data of a result beside its verdict and zero offsets."""

    method: str | None = None
    parameters: tuple[Quantity, ...] = ()
    """Every identified parameter except the zero offsets."""
    weak_direction: WeakDirection | None = None
    before: Accuracy | None = None
    """Accuracy without compensation."""
    after: Accuracy | None = None
    """Accuracy with the identified offsets applied."""
    accuracy: AccuracyReached | None = None
    """Predicted position accuracy, with the required one; null if no offsets were identified."""
    advice: tuple[Advice, ...] = ()
    """The most effective measures, by gain per minute; only those with a benefit."""
    check: CheckFound | None = None
    """Result of a check."""
    iterations: tuple[Iteration, ...] = ()
    residuals: tuple[Residual, ...] = ()
    """Residuals of the readings of the fit."""
    memory: MemoryUse | None = None
    """Null if there was no knowledge of this robot before."""
    fleet: FleetUse | None = None
    """Null if there was knowledge of this robot, or of no others of its type."""
    references: tuple[ReferenceUse, ...] = ()
    """References from other instruments, and how well they agree with the other data."""
    lack_of_fit: str | None = None
    """The misfit of the model; null if it fits or was not tested."""
    lack_of_fit_reason: Reason | None = None
    """The same by its code, for other languages; null in results of older versions, too."""
    findings: tuple[Finding, ...] = ()
    """Effects that the model lacked, strongest first."""


class CalibrationResult(ResultParts):
    """The end result of a run. `verdict` is "pass" only if every check passed on finite numbers."""

    verdict: Verdict
    outcome: Outcome
    reason: Reason
    zero_offsets: tuple[Quantity, ...]
    """dtheta1, dtheta2 in deg."""
    lasting: LastingParameters | None = None
    diagnosis: DiagnosisDocument | None = None
    """The whole document; None if none was requested."""
