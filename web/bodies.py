"""Bodies and answers over HTTP. The OpenAPI file and the page's types are made from them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Literal

from pydantic import (
    AfterValidator,
    ConfigDict,
    Field,
    JsonValue,
    StringConstraints,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)

from drivers.strict_numbers import StrictNumbers
from station.errors import InputRefused
from station.five_bar import Robot as RobotFile
from station.plans import PLANS
from station.records import (
    LARGEST_ID,
    AnyReference,
    CalibrationSummary,
    KeptRobot,
    Measured,
    MemorySummary,
    Phrase,
    Positive,
    Reading,
    Record,
    Sections,
    StudyDesign,
    TaughtPosition,
    TranslatedPosition,
    checked_name,
    checked_serial,
)


def _as_value(check: Callable[[str], str]) -> AfterValidator:
    """A check of `station.records` as a pydantic validator."""

    def validate(text: str) -> str:
        try:
            return check(text)
        except InputRefused as refused:
            raise ValueError(str(refused)) from refused

    return AfterValidator(validate)


Serial = Annotated[
    str,
    StringConstraints(strip_whitespace=True, min_length=1, max_length=64),
    _as_value(checked_serial),
    # for readers of the schema; a person gets the sentence of the check
    Field(json_schema_extra={"pattern": r"^[\w.\-/]+$"}),
]
Name = Annotated[
    str,
    StringConstraints(strip_whitespace=True, min_length=1, max_length=64),
    _as_value(checked_name),
    # for readers of the schema; a person gets the sentence of the check
    Field(json_schema_extra={"pattern": r"^[^\u0000-\u001f\u007f-\u009f\u2028\u2029]*$"}),
]


def _known_plan(name: str) -> str:
    if name not in PLANS:
        raise ValueError(f"must be one of {', '.join(PLANS)}")
    return name


Plan = Annotated[
    str, AfterValidator(_known_plan), WithJsonSchema({"type": "string", "enum": [*PLANS], "title": "Plan"})
]


LONGEST_MAP = 20_000
"""Characters of a column map."""


class Body(StrictNumbers):
    """A request body: unknown fields are refused."""

    model_config = ConfigDict(extra="forbid", defer_build=False)  # FastAPI requires built models


class CalibrationBody(Body):
    """A calibration request: robot, plan and requester."""

    robot_serial: Serial
    plan: Plan
    operator: Name
    work_order: Name | None = None
    metadata: dict[str, JsonValue] = Field(default_factory=dict)
    references: tuple[AnyReference, ...] = Field(
        default_factory=tuple, max_length=20, description="what other instruments measured; for this run"
    )
    accuracy_mm: Positive | None = Field(
        default=None, description="largest position error that is wanted; else the robot file's"
    )
    until_mm: Positive | None = Field(
        default=None, description="the same, and plan `adaptive` ends as soon as it is reached"
    )
    study: StudyDesign | None = Field(
        default=None, description="how often plan `gauge_study` calibrates; for that plan alone"
    )

    @field_validator("study")
    @classmethod
    def _study_belongs_to_its_plan(
        cls, study: StudyDesign | None, info: ValidationInfo
    ) -> StudyDesign | None:
        if study is not None and info.data.get("plan") != "gauge_study":
            raise ValueError("belongs to plan gauge_study; leave it out or choose that plan")
        return study


class DatasetFields(Body):
    """Robot and requester of an import; in the query, or as fields beside the files."""

    robot_serial: Serial = Field(
        default=RobotFile.default().serial, description="without a file kept here: the paper's robot"
    )
    operator: Name = "REST"
    work_order: Name | None = None
    columns: str | None = Field(
        default=None,
        max_length=LONGEST_MAP,
        description="column map (TOML) of a file from other software, as `station columns` proposes it",
    )
    measured: Measured = Field(
        default="position", description="which measurement to use if the log of an arm contains both"
    )
    hold_out: bool = Field(
        default=False, description="hold a quarter of an arm's log out of the fit and test the causes with it"
    )


class ApplyBody(Body):
    """The requester of an application, a rollback or a continued run."""

    operator: Name


class AnswerBody(Body):
    """The answer to the prompt of a run."""

    prompt: str = Field(description="`id` of the prompt")
    value: float | None = Field(default=None, description="where a number is asked for")


class TranslateBody(Body):
    """Positions that were taught under other zeros: listed, or as the text of a file."""

    positions: list[TaughtPosition] | None = Field(default=None, min_length=1, max_length=10_000)
    text: str | None = Field(
        default=None,
        max_length=1_000_000,
        description="instead of `positions`: a CSV file, or a program in KRL or RAPID with joint targets",
    )
    taught_under: int | None = Field(
        default=None, ge=1, le=LARGEST_ID, description="the run after whose application they were taught"
    )
    back: bool = Field(
        default=False, strict=True, description="take translated positions back to what they were"
    )

    @model_validator(mode="after")
    def _one_source(self) -> TranslateBody:
        if (self.positions is None) == (self.text is None):
            raise ValueError("give either positions or text")
        return self


class TranslatedList(Record):
    """Translated positions, in the order of the request."""

    items: list[TranslatedPosition]
    program: str | None = Field(default=None, description="the program of `text` with the new angles")
    next: None = None


class ClearBody(Body):
    """Who permits work with a robot again after a failed check, and the reason."""

    operator: Name
    reason: Annotated[str, StringConstraints(strip_whitespace=True, min_length=3, max_length=500)]


class SeparatingStop(Record):
    position: str
    x_mm: float
    y_mm: float


class Separating(Record):
    """The motion that distinguishes the causes which a run left undecided."""

    apart: list[str]
    """Alternative causes that it should rule out, or confirm instead."""
    stops: list[SeparatingStop] = Field(description="in measuring order; empty when there is none")
    duration_s: float | None
    refused: str | None = Field(description="why there is none, null when it can be run")


class ResidualRow(Record):
    """One reading that a diagnosis learned from, with all quantities its residual may be ordered by."""

    reading: int
    position: str
    x_mm: float
    y_mm: float
    t_s: float
    theta1_deg: float = Field(description="actual angle, zero offset included")
    theta2_deg: float
    approach1: int
    approach2: int
    travel_mm: float
    temperature_rise_k: float | None
    before_mm: float = Field(description="measured less base model")
    by_effect_mm: list[float] = Field(description="what each of `effects` accounts for")
    after_mm: float = Field(description="what the last model leaves")
    limit_mm: float


class ResidualList(Record):
    """Residuals before and after; `effects` in the order in which they were added."""

    effects: list[str]
    items: list[ResidualRow]
    next: None = None


Sense = Literal[-1, 0, 1]
Finite = Annotated[float, Field(allow_inf_nan=False)]
MOST_TARGETS = 10_000


class Target(Body):
    """Target position of P, and the conditions that an effect may depend on there."""

    x_mm: Finite
    y_mm: Finite
    approach1: Sense = Field(default=0, description="sign of the joint's last motion; 0 not known")
    approach2: Sense = 0
    temperature_c: Finite | None = Field(default=None, description="null: as at the run's first reading")
    payload_kg: Finite | None = None


class SolveBody(Body):
    """Targets for commands under the identified model."""

    targets: list[Target] = Field(min_length=1, max_length=MOST_TARGETS)


class JointCommand(Record):
    theta1_deg: float
    theta2_deg: float


class Solution(Record):
    """Joint commands in the drives' nominal frame, one for each target, in order."""

    commands: list[JointCommand]
    range: str = Field(description="the ranges of the joints that the model was learned on, and its effects")
    range_said: Phrase = Field(description="the same by its code, for other languages")
    confirmed: bool | None = Field(description="false: fresh readings refuted the model; null: never asked")


class Robot(Record):
    """The data of a robot in this station."""

    serial: str
    file: Sections = Field(description="the sections of its robot file")
    memory: MemorySummary | None = Field(description="null when nothing is known")


class RobotList(Record):
    items: list[KeptRobot]
    next: str | None = Field(description="cursor of the next page, null on the last")


class CalibrationList(Record):
    items: list[CalibrationSummary]
    next: int | None = Field(description="cursor of the next page, null on the last")


class ReadingAnswer(Record):
    """One row of the measurement file."""

    reading: int
    t_s: float
    theta1_deg: float
    theta2_deg: float
    approach1: int
    approach2: int
    scale_mm: float
    position: str
    walk: int
    temperature_c: float | None = None
    payload_kg: float | None = None
    mount: str | None = None

    @classmethod
    def of(cls, reading: Reading) -> ReadingAnswer:
        return cls(
            reading=reading.reading,
            t_s=reading.t_s,
            theta1_deg=reading.theta_deg[0],
            theta2_deg=reading.theta_deg[1],
            approach1=reading.approach[0],
            approach2=reading.approach[1],
            scale_mm=reading.scale_mm,
            position=reading.position,
            walk=reading.sequence,
            temperature_c=reading.temperature_c,
            payload_kg=reading.payload_kg,
            mount=reading.mount,
        )


class ReadingList(Record):
    items: list[ReadingAnswer]
    next: None = None


class Stopped(Record):
    """Answer of the drives to the quick stop; an active run is being aborted."""

    axes: dict[str, str | None] = Field(description="by axis: null when it confirmed, else what went wrong")
    confirmed: bool = Field(description="whether every axis confirmed; if not, use the emergency stop")

    @classmethod
    def of(cls, axes: dict[str, str | None]) -> Stopped:
        return cls(axes=axes, confirmed=bool(axes) and all(trouble is None for trouble in axes.values()))


class Alive(Record):
    status: Literal["alive"] = "alive"


class Ready(Record):
    status: Literal["ready"] = "ready"
