"""The document of a diagnosis, as `station diagnose --json` writes it.

Schema station.diagnosis/2 is that of a five-bar, with the set of its explanations; station.diagnosis/1 is
that of an arm, and of a five-bar in earlier versions.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from station.records.accuracy import PositionError, WeakDirection
from station.records.measurements import Motion
from station.records.phrases import Phrase
from station.records.quantity import Quantity
from station.records.record import Record
from station.records.sections import Sections

MODEL_SCHEMA = "station.model/1"

MIXTURE_SCHEMA = "station.model/2"
DIAGNOSIS_SCHEMA = "station.diagnosis/2"

DiagnosisVerdict = Literal["adequate", "explained", "ambiguous", "partly_explained", "unexplained"]
Span = tuple[float, float]


class DataSource(Record):
    """The source of a document."""

    file: str
    readings: int
    sha256: str
    guessed: tuple[str, ...] = ()
    """Columns that were inferred from the order of the rows."""


class NoiseOfReadings(Record):
    """The noise with which the readings were judged."""

    sigma_mm: float
    source: Literal["repeats", "specification"]
    dof: int
    """Degrees of freedom of the repeats; 0 if the specification was used."""


class EffectName(Record):
    """An effect of the catalogue and the joint at which it acts."""

    effect: str
    joint: int | None = None
    part: str | None = None
    """The part on which it acts: "L1", "links", "scale", "joint1" and so on."""


class Finding(EffectName):
    """One effect that the model lacked."""

    label: str
    parameters: tuple[Quantity, ...]
    share: float
    """Share of the base residual's sum of squares that this effect accounts for."""
    p_value: float
    probability: float | None = None
    """Probability that the effect or one of its alias set is present; null in schema 1."""
    alias_set: tuple[EffectName, ...]
    """The effect and those that these readings cannot distinguish from it."""
    remedy: str
    remedy_said: Phrase | None = None
    """The remedy by its code, for other languages; null where there is none, and in older documents."""
    separating_experiment: str | None = None
    separating_experiment_said: Phrase | None = None
    """The same by its code."""


class JointCurve(Record):
    """The learned curve of one joint over the angles visited."""

    joint: int
    angle_deg: tuple[float, ...]
    value_deg: tuple[float, ...]
    sd_deg: tuple[float, ...]


class StageErrors(Record):
    """Measured less predicted under one model: readings learned, positions excluded, fresh readings."""

    model: str
    unknowns: int
    """Number of unknowns of geometry, mechanism and effects; reading offsets are not counted."""
    fit_rms_mm: float
    holdout_rms_mm: float
    holdout_max_mm: float
    confirm_rms_mm: float | None
    confirm_max_mm: float | None


class StageAccuracy(StageErrors):
    """The same with the predicted position error, and the true one if a tracker measured it."""

    predicted_position_error_mm: PositionError
    true_position_error_mm: PositionError | None


class Dependence(Record):
    """A quantity that the residual depends on, found without the catalogue."""

    depends_on: str
    strength: float
    """Share of the residual's sum of squares that it accounts for, 0 to 1."""
    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null in documents of older versions."""


class SmallestVisible(EffectName):
    """One effect that was not found, and the size that these readings detect with 80 % probability."""

    label: str
    parameter: str | None
    minimum_detectable: float | None
    """Null if these readings cannot detect the effect at all."""
    unit: str | None
    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null where it is empty, and in older documents."""


class ExplainedEffect(EffectName):
    """One error of an explanation."""

    label: str
    parameters: tuple[Quantity, ...]
    depends_on: str | None = None
    """Dependence of an unnamed error: "joint1", "joint2", "reading", "place", "time" or "approach"."""


class ExplanationRecord(Record):
    """A set of errors that would account for the readings; the empty set is the base model."""

    effects: tuple[ExplainedEffect, ...]
    probability: float
    named: bool


class ExperimentRecord(Record):
    """An experiment that can distinguish explanations."""

    kind: str
    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null in documents of older versions."""
    decides: float
    """Probability that it decides between the explanations."""


class MistakeRecord(Record):
    """A data-entry mistake."""

    kind: str
    text: str
    said: Phrase | None = None
    """The text by its code, for other languages; null in documents of older versions."""
    rows: tuple[int | str, ...]


class RefusedDiagnosis(Record):
    """The document for a file that cannot be diagnosed before a mistake in it is corrected."""

    schema_: Annotated[Literal["station.diagnosis/2"], Field(alias="schema")] = "station.diagnosis/2"
    refused: str
    mistake: MistakeRecord


class _Finite(Record):
    """A number that is not finite is refused: commands are computed from these."""

    model_config = ConfigDict(allow_inf_nan=False)


class TermOfModel(_Finite):
    """One effect with its searched parameters fixed."""

    effect: str
    """Label in the catalogue."""
    on_joint: Annotated[int, Field(ge=1)] | None
    on_lengths: dict[str, float] | None
    """mm per unit of strength."""
    on_motion: Motion | None = None
    """Along the motion of all joints; if this, lengths and joint are null, it acts on the reading."""
    hidden: dict[str, float]
    amplitudes: Annotated[tuple[float, ...], Field(min_length=1)]


class LearnedRanges(_Finite):
    """The ranges covered by the readings that the model was learned from."""

    joints_deg: Annotated[tuple[Span, ...], Field(min_length=2)]
    visited_deg: tuple[tuple[Span, ...], ...]
    """For each joint, the intervals in which readings are dense enough."""
    travel_mm: Span | None
    time_s: Span


class TemperatureReference(_Finite):
    """The reference that temperatures are counted from."""

    temperature_c: float | None


class ModelDocument(_Finite):
    """All that commands and a transfer need of a model; mm and rad, base parameters, then amplitudes."""

    schema_: Annotated[Literal["station.model/1"], Field(alias="schema")] = "station.model/1"
    robot: Sections
    names: tuple[str, ...]
    values: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...] | None
    """Null for a hundred values or more."""
    terms: tuple[TermOfModel, ...]
    ranges: LearnedRanges
    reference: TemperatureReference
    stage: str | None = None
    confirmed: bool | None = None
    """False: fresh readings refuted it; null: no fresh readings were taken."""


class ReferenceOfReadings(TemperatureReference):
    """The reference that later readings are counted from."""

    theta_rad: tuple[float, float]
    travel_mm: float


class LearnedReadings(_Finite):
    """The readings that a set of explanations was weighed on: the shapes of its errors depend on them."""

    t_s: tuple[float, ...]
    theta_rad: tuple[tuple[float, float], ...]
    approach: tuple[tuple[int, int], ...]
    distance_mm: tuple[float, ...]
    came_from: tuple[tuple[float | None, float | None, float | None], ...]
    """Joint angles, rad, and distance, mm, of the previous reading; null if there is none."""
    mount: tuple[int, ...]
    mounts: tuple[str, ...]
    temperature_c: tuple[float, ...] | None
    payload_kg: tuple[float, ...] | None


class ErrorOfModel(_Finite):
    """One error of an explanation with all its parameters fixed."""

    family: int
    """Its number in the catalogue of explanations."""
    kind: str
    labels: tuple[str, ...]
    joints: tuple[int, ...]
    """Joints whose angle it changes: it is unknown outside the range they visited."""
    by_approach: tuple[int, ...]
    """Joints whose side of approach it depends on."""
    hidden: dict[str, float]
    amplitudes: tuple[float, ...]


class ExplanationOfModel(_Finite):
    """One explanation as commands use it."""

    probability: float
    values: tuple[float, ...]
    """Base parameters, mm and rad."""
    errors: tuple[ErrorOfModel, ...]


class MixtureDocument(_Finite):
    """All that commands need of a set of explanations; mm and rad."""

    schema_: Annotated[Literal["station.model/2"], Field(alias="schema")] = "station.model/2"
    robot: Sections
    names: tuple[str, ...]
    values: tuple[float, ...]
    """Base parameters, mean over the explanations."""
    covariance: tuple[tuple[float, ...], ...]
    """Covariance of the base parameters, over the explanations."""
    explanations: Annotated[tuple[ExplanationOfModel, ...], Field(min_length=1)]
    start: tuple[float, ...]
    """Base parameters at which the catalogue of explanations was made."""
    readings: LearnedReadings
    ranges: LearnedRanges
    reference: ReferenceOfReadings
    stage: str | None = None
    confirmed: bool | None = None
    """False: it is not confirmed, or fresh readings contradict it; null: no fresh readings were taken."""


AnyModelDocument = Annotated[ModelDocument | MixtureDocument, Field(discriminator="schema_")]


DiagnosisSchema = Literal["station.diagnosis/1", "station.diagnosis/2"]


class DiagnosisDocument(Record):
    """The findings from one set of readings."""

    schema_: Annotated[DiagnosisSchema, Field(alias="schema")] = "station.diagnosis/1"
    data: DataSource
    noise: NoiseOfReadings
    verdict: DiagnosisVerdict
    confirmed: bool | None
    """Null without fresh readings."""
    sentence: str
    parameters: tuple[Quantity, ...]
    weak_direction: WeakDirection
    findings: tuple[Finding, ...]
    curves: tuple[JointCurve, ...]
    stages: tuple[StageErrors, ...]
    before: StageAccuracy
    after: StageAccuracy
    hints: tuple[Dependence, ...]
    invisible: tuple[SmallestVisible, ...]
    outliers: tuple[int | str, ...]
    outlier_reasons: tuple[str, ...] = ()
    outlier_reasons_said: tuple[Phrase, ...] = ()
    """The reasons by their codes, for other languages; none in documents of older versions."""
    fresh_outliers: tuple[int | str, ...] = ()
    explanations: tuple[ExplanationRecord, ...] = ()
    """All explanations with a probability of 0.01 or more, most probable first; none in schema 1."""
    experiments: tuple[ExperimentRecord, ...] = ()
    """Experiments that can distinguish them, best first."""
    mistake: MistakeRecord | None = None
    model: AnyModelDocument
