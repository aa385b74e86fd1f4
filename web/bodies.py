"""What travels over HTTP: bodies and answers.  The OpenAPI file and the page's types come from here."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, ConfigDict, Field, JsonValue, StringConstraints

from station.five_bar import Robot as RobotFile
from station.records import PlanName, Reading, State

Serial = Annotated[
    str, StringConstraints(strip_whitespace=True, min_length=1, max_length=64, pattern=r"^[\w.\-/]+$")
]
Name = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=64)]


class Answer(BaseModel):
    """Base of all answers: a field is always there, null when nothing is known."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=True)


class CalibrationBody(BaseModel):
    """What to calibrate, how, and who asks."""

    model_config = ConfigDict(extra="forbid")

    robot_serial: Serial
    plan: PlanName
    operator: Name
    work_order: Name | None = None
    metadata: dict[str, JsonValue] = Field(default_factory=dict)


class DatasetFields(BaseModel):
    """Whose readings are imported, and by whom; in the query, or as fields beside the files."""

    model_config = ConfigDict(extra="forbid")

    robot_serial: Serial = Field(
        default=RobotFile.default().serial, description="without a file kept here: the paper's robot"
    )
    operator: Name = "REST"
    work_order: Name | None = None


class ZeroOffset(Answer):
    joint: int
    value_deg: float | None
    sd_deg: float | None


class PositionError(Answer):
    rms: float | None
    max: float | None


class Accuracy(Answer):
    """How well the robot positions, before or after; of a diagnosis, without its effects or with them."""

    reading_rms_mm: float | None = None
    fresh_reading_rms_mm: float | None = Field(
        default=None, description="readings that took no part in the fit"
    )
    predicted_position_error_mm: PositionError | None = None


class Quantity(Answer):
    name: str
    value: float | None
    sd: float | None
    unit: str


class WeakDirection(Answer):
    singular_ratio: float | None = None
    text: str = ""
    sd_deg: float | None = None
    remedy: str | None = None


class Residual(Answer):
    reading: int
    position: str | None = None
    residual_mm: float | None
    limit_mm: float | None = None


class Iteration(Answer):
    """One pass of measuring and solving."""

    number: int = Field(alias="pass")
    dtheta1_deg: float | None = None
    dtheta2_deg: float | None = None
    total1_deg: float | None = None
    total2_deg: float | None = None
    mu_deg: float | None = None


class MemoryUse(Answer):
    """Whether what earlier runs know of geometry and mechanism took part."""

    used: bool
    p_value: float | None = Field(description="of the readings under the memory")
    text: str
    from_calibration: int
    age_days: float | None


class CalibrationSummary(Answer):
    """One line of the history."""

    id: int
    robot_serial: str
    plan: str = Field(
        description="of a calibration; or `apply`, `rollback`, `separating`, of the run `of`; or `dataset`"
    )
    of: int | None = None
    operator: str
    work_order: str | None = None
    state: State
    verdict: Literal["pass", "fail"] | None
    reason: str | None = None
    step: int | None = None
    steps: int | None = None
    created_at: datetime
    started_at: datetime | None = None
    ended_at: datetime | None = None
    zero_offsets: list[ZeroOffset] | None = None


ApplicationState = Literal["unwritten", "applied", "partly", "in doubt", "rolled back", "superseded"]


class ApplyBody(BaseModel):
    """Who writes zero offsets to the drives, takes them back, or goes on from a run."""

    model_config = ConfigDict(extra="forbid")

    operator: Name


class JointApplication(Answer):
    """One drive: `shift_deg` is how far its frame has moved since the calibration."""

    joint: int
    state: ApplicationState
    old_offset_deg: float
    shift_deg: float | None
    new_offset_deg: float | None = Field(description="what is left of the zero offset in the drive's frame")


class ApplicationRun(Answer):
    """One attempt to apply or to roll back."""

    id: int
    plan: Literal["apply", "rollback"]
    operator: str
    state: State
    verdict: Literal["pass", "fail"] | None
    reason: str | None
    ended_at: datetime | None


class Application(Answer):
    """What the drives hold of a calibration's zero offsets."""

    state: ApplicationState
    verified: bool
    text: str
    joints: list[JointApplication]
    runs: list[ApplicationRun]
    apply_refused: str | None = Field(description="why it cannot be applied, null when it can")
    rollback_refused: str | None = Field(description="why it cannot be rolled back, null when it can")


class Calibration(CalibrationSummary):
    """All that is known about one run."""

    metadata: dict[str, JsonValue] = Field(default_factory=dict)
    method: str | None = None
    zero_offset_tolerance_deg: float | None = None
    parameters: list[Quantity] | None = None
    weak_direction: WeakDirection | None = None
    application: Application | None = Field(default=None, description="null unless the run has passed")
    memory: MemoryUse | None = Field(default=None, description="null when nothing was known")
    lack_of_fit: str | None = Field(
        default=None, description="what the model does not account for; null when it fits or none was judged"
    )
    before: Accuracy | None = None
    after: Accuracy | None = None
    iterations: list[Iteration] | None = None
    residuals: list[Residual] | None = None
    findings: list[dict[str, JsonValue]] = Field(default_factory=list)


class SeparatingStop(Answer):
    position: str
    x_mm: float
    y_mm: float


class Separating(Answer):
    """The motion that tells what a run found from its look-alikes."""

    apart: list[str] = Field(description="look-alikes that it should rule out, or confirm instead")
    stops: list[SeparatingStop] = Field(description="in measuring order; empty when there is none")
    duration_s: float | None
    refused: str | None = Field(description="why there is none, null when it can be run")


class ResidualRow(Answer):
    """One reading that a diagnosis learned from, with all that its residual may be ordered by."""

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


class ResidualList(Answer):
    """Residuals before and after; `effects` in the order in which they were added."""

    effects: list[str]
    items: list[ResidualRow]
    next: None = None


Sense = Literal[-1, 0, 1]
Finite = Annotated[float, Field(allow_inf_nan=False)]
MOST_TARGETS = 10_000


class Target(BaseModel):
    """Where P is to go, and what an effect may depend on there."""

    model_config = ConfigDict(extra="forbid")

    x_mm: Finite
    y_mm: Finite
    approach1: Sense = Field(default=0, description="sign of the joint's last motion; 0 not known")
    approach2: Sense = 0
    temperature_c: Finite | None = Field(default=None, description="null: as at the run's first reading")
    payload_kg: Finite | None = None


class SolveBody(BaseModel):
    """Targets to be commanded under the identified model."""

    model_config = ConfigDict(extra="forbid")

    targets: list[Target] = Field(min_length=1, max_length=MOST_TARGETS)


class JointCommand(Answer):
    theta1_deg: float
    theta2_deg: float


class Solution(Answer):
    """Joint commands in the drives' nominal frame, one a target, in their order."""

    commands: list[JointCommand]
    range: str = Field(description="what the model was learned on")
    confirmed: bool | None = Field(description="false: fresh readings refuted the model; null: never asked")


class MemorySummary(Answer):
    """What the robot's next run will start from."""

    from_calibration: int
    at: datetime
    age_days: float
    parameters: list[Quantity]


class Robot(Answer):
    """A robot as it is known here."""

    serial: str
    file: dict[str, Any] = Field(description="the sections of its robot file")
    memory: MemorySummary | None = Field(description="null when nothing is known")


class CalibrationList(Answer):
    items: list[CalibrationSummary]
    next: int | None = Field(description="cursor of the next page, null on the last")


class ReadingAnswer(Answer):
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
            walk=reading.walk,
            temperature_c=reading.temperature_c,
            payload_kg=reading.payload_kg,
            mount=reading.mount,
        )


class ReadingList(Answer):
    items: list[ReadingAnswer]
    next: None = None


class StationInfo(Answer):
    name: str
    emulated: bool
    limits: dict[str, Any] = Field(default_factory=dict)
    plans: list[PlanName] = Field(default=list(get_args(PlanName)), description="plans this station can run")


class Device(Answer):
    name: str
    kind: str
    address: str
    state: Literal["ok", "lost", "fault", "unknown"]
    text: str = ""


class Interlock(Answer):
    id: str
    text: str
    ok: bool
    detail: str | None = None


class Machine(Answer):
    """Live values, `age_s` old when they were sent."""

    theta1_deg: float | None
    theta2_deg: float | None
    x_mm: float | None
    y_mm: float | None
    scale_mm: float | None
    age_s: float | None


class Workspace(Answer):
    x: tuple[float, float]
    y: tuple[float, float]


class WalkTitle(Answer):
    number: int
    title: str


class RunStop(Answer):
    position: str
    x_mm: float
    y_mm: float
    done: bool


class RunReading(Answer):
    reading: int
    position: str
    x_mm: float | None = None
    y_mm: float | None = None
    theta1_deg: float
    theta2_deg: float
    scale_mm: float
    sd_mm: float | None = None
    residual_mm: float | None = None
    limit_mm: float | None = None
    t_s: float
    walk: int


class Run(Answer):
    """The run that holds the rig."""

    id: int
    state: State
    robot_serial: str
    plan: str
    of: int | None = None
    operator: str
    work_order: str | None = None
    started_at: datetime | None = None
    elapsed_s: float | None = None
    remaining_s: float | None = None
    walk: WalkTitle | None = None
    step: int | None = None
    steps: int | None = None
    stops: list[RunStop] = Field(default_factory=list)
    readings: list[RunReading] = Field(default_factory=list)
    iterations: list[Iteration] = Field(default_factory=list)


class Station(Answer):
    """The whole station at one moment; also the `data` of the live feed's snapshot."""

    station: StationInfo
    devices: list[Device]
    interlocks: list[Interlock]
    machine: Machine | None
    workspace: Workspace
    run: Run | None
    last: CalibrationSummary | None


class Stopped(Answer):
    """Both axes confirmed the quick stop; a run under way is being aborted."""

    stopped: Literal[True] = True
    by: str


class Alive(Answer):
    status: Literal["alive"] = "alive"


class Ready(Answer):
    status: Literal["ready"] = "ready"
