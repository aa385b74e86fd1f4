"""What the station takes and answers.  Made by `make reference`; do not edit.

From schemas with SHA-256 eeff8a9667b41608c77876b0394a4b76ad50aa0168f08b126d2e37c0ac48a32d.
"""

from __future__ import annotations

from datetime import date
from typing import Annotated, Any, Literal

from pydantic import AwareDatetime, BaseModel, Field


class JointAngle(BaseModel):
    """
    The angle of a proximal link, measured in the robot's frame at standstill of the drive.
    """

    kind: Literal["joint_angle"] = "joint_angle"
    joint: Literal[1, 2]
    at_deg: float
    reads_deg: float
    sd_deg: float


class MountingError(BaseModel):
    """
    A measured error of the mechanism's mounting (MAEMM): of c + d, sideways or in height.
    """

    kind: Literal["drm_x", "drm_y"]
    value_mm: float
    sd_mm: float


class StudyDesign(BaseModel):
    """
    Every operator mounts the mechanism several times; each mounting is calibrated several times.
    """

    operators: int | None = 3
    mountings: int | None = 2
    repeats: int | None = 2


class Quantity(BaseModel):
    """
    A value with its standard uncertainty and unit.
    """

    name: str
    value: float
    sd: float
    unit: str


class Phrase(BaseModel):
    """
    `code` is a template in `station.messages`; every language uses the same parameters.
    """

    code: str
    params: dict[str, float | int | str | Phrase | list[str | Phrase]]
    """
    Numbers, names of columns and keys, other phrases, or several of these, which are joined by "and".
    """


class Remedy(BaseModel):
    """
    A measurement that would determine a weak direction, and the zero offsets' standard uncertainty.
    """

    text: str
    said: Phrase | None
    """
    The text by its code, for other languages; null in documents of older versions.
    """

    sd_deg: float


class PositionError(BaseModel):
    """
    Position error over the workspace or the measured poses, mm.
    """

    rms: float
    max: float
    bound_95: float | None
    """
    With 95 % probability no error is larger; null if only one model was considered.
    """


class AccuracyReached(BaseModel):
    """
    The predicted position accuracy of a calibration, with the required one.
    """

    bound_95_mm: float | None
    """
    With 95 % probability no position error over the workspace is larger, with the zeros in the drives
    only, as with the robot's own controller.
    """

    bound_95_model_mm: float | None
    """
    The same with joint commands computed from the identified model.
    """

    wanted_mm: float | None
    """
    Required accuracy; null if not specified.
    """

    reached: bool | None
    """
    Whether `bound_95_mm` meets the requirement; null without one.
    """

    stopped_because: str | None
    """
    Why no further readings were taken.
    """

    stopped_because_said: Phrase | None
    """
    The same by its code, for other languages; null in results of older versions, too.
    """


class Advice(BaseModel):
    """
    A measure that would improve a calibration.
    """

    kind: str
    """
    `repeat`, `joint_angle`, `drm_x` or `second_mount`.
    """

    text: str
    joint: int | None
    """
    The joint, if `kind` is `joint_angle`.
    """

    gain_mm: float
    """
    Reduction of the bound on the largest position error, with the zeros in the drives only.
    """

    minutes: float


class CheckFound(BaseModel):
    """
    The smallest shift of the zeros that a check detects, and the shift found.
    """

    smallest_shift_deg: float
    """
    A shift of either zero of this size is detected with 99 % probability.
    """

    smallest_by_joint_deg: Annotated[list[Any], Field(min_length=2)]
    shift_deg: Annotated[list[Any], Field(min_length=2)]
    """
    The shift of each zero that explains the readings best.
    """

    p_value: float
    """
    p-value of the readings, if nothing has changed.
    """

    blind: str
    """
    The direction of both zeros together in which a shift has the smallest effect.
    """

    blind_shift_deg: float
    """
    The smallest shift detected along it.
    """

    valid_until: AwareDatetime | None
    """
    End of the check's validity; null if it failed.
    """

    known_by: int | None
    """
    The newer calibration that has found this shift and is not applied; null if there is none.
    """


class Iteration(BaseModel):
    """
    One pass of measuring and solving (eq. 29 to 33).
    """

    pass_: Annotated[int, Field(alias="pass")]
    dtheta1_deg: float | None
    dtheta2_deg: float | None
    total1_deg: float | None
    total2_deg: float | None
    mu_deg: float | None
    condition: float | None


class Residual(BaseModel):
    """
    Residual of one reading: measured less predicted.
    """

    reading: int
    position: str | None
    residual_mm: float | None
    limit_mm: float | None


class MemoryUse(BaseModel):
    """
    Whether the knowledge of geometry and mechanism from earlier runs was used.
    """

    used: bool
    p_value: float | None
    """
    p-value of the readings under the memory.
    """

    text: str
    said: Phrase | None
    """
    The text by its code, for other languages; null in records of older versions.
    """

    from_calibration: int
    age_days: float | None


class FleetPrior(BaseModel):
    """
    Expected geometry of a robot from others of its type, before it is measured: mm and mm^2.
    """

    type: str
    """
    Type as in the robot files.
    """

    serials: list[str]
    """
    Serials of those others.
    """

    names: list[str]
    mean: list[float]
    covariance: list[list[float]]


class ReferenceUse(BaseModel):
    """
    A reference that was used in a fit, and how well all other data agree with it.
    """

    reference: Annotated[JointAngle | MountingError, Field(discriminator="kind")]
    residual: float | None
    """
    Reference less the value from all other data, in the unit of the parameter; null if the other data do
    not determine it.
    """

    sd: float | None
    """
    Standard uncertainty of that difference.
    """

    unit: str
    p_value: float | None
    """
    p-value of that difference, if both are correct; null if it was not tested.
    """


class Reason(BaseModel):
    """
    `code` is one of the reasons in `station.messages`; other languages use the same parameters.
    """

    code: str
    params: dict[str, float | int | str | Phrase]


class EffectName(BaseModel):
    """
    An effect of the catalogue and the joint at which it acts.
    """

    effect: str
    joint: int | None
    part: str | None
    """
    The part on which it acts: "L1", "links", "scale", "joint1" and so on.
    """


class ZeroOffset(BaseModel):
    """
    Actual minus nominal angle of one joint.
    """

    joint: int
    value_deg: float | None
    sd_deg: float | None


class Prompt(BaseModel):
    """
    A question with a time limit.
    """

    id: str
    """
    Identifier to return with the answer.
    """

    text: str
    kind: str
    """
    Whether a number is requested.  Today `confirm`, `number`.
    """

    unit: str | None
    expires_at: AwareDatetime
    """
    Without an answer the run ends at this time.
    """


class JointApplication(BaseModel):
    """
    One drive: `shift_deg` is the movement of its frame since the calibration.
    """

    joint: int
    state: str
    """
    Today `unwritten`, `applied`, `partly`, `in doubt`, `rolled back`, `superseded`.
    """

    old_offset_deg: float
    shift_deg: float | None
    new_offset_deg: float | None
    """
    The remaining zero offset in the drive's frame.
    """


class ApplicationRun(BaseModel):
    """
    One attempt to apply or to roll back.
    """

    id: int
    plan: str
    """
    Today `apply`, `rollback`.
    """

    operator: str
    state: str
    """
    State of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    verdict: str | None
    reason: str | None
    ended_at: AwareDatetime | None


class DeviceUsed(BaseModel):
    """
    One device as in the station file.
    """

    name: str
    driver: str
    address: str


class ScaleCertificate(BaseModel):
    """
    The calibration certificate of the linear scale, as in the station file.
    """

    scale: str
    """
    Serial number of the scale.
    """

    certificate: str
    """
    Number of its certificate.
    """

    laboratory: str
    """
    Laboratory that calibrated it.
    """

    calibrated: date
    """
    Day of the calibration.
    """

    due: date
    """
    Last day of its validity.
    """

    u95_um: float
    """
    Expanded uncertainty (k = 2) of a length, the part independent of the length, um.
    """

    u95_um_per_m: float
    """
    The part proportional to the length, um/m.
    """

    expansion_ppm_per_k: float
    """
    Linear expansion of the scale.
    """

    temperature_c: float
    """
    Temperature of the scale in operation; readings with a temperature state their own.
    """

    temperature_within_k: float
    """
    The temperature is within this of the stated value; every value is equally likely (GUM, 4.3.7).
    """


class CalibrationSummary(BaseModel):
    """
    One line of the history.
    """

    id: int
    uid: str
    """
    UUIDv7; unlike the number, it is unique over all stations, and after a restore.
    """

    robot_serial: str
    kind: str
    """
    Kind of run: `calibrate`, `diagnose`, `separate`, `apply`, `rollback` or `import`.
    """

    plan: str
    """
    Plan of a calibration; otherwise `apply`, `rollback`, `separating` or `dataset`.
    """

    of: int | None
    """
    The run that it belongs to, for instance the one whose offsets it applied.
    """

    operator: str
    work_order: str | None
    state: str
    """
    State of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    verdict: str | None
    outcome: str | None
    """
    Null until the run has ended.
    """

    reason: str | None
    """
    Reason in English.
    """

    reason_code: str | None
    """
    The reason's code for other languages, with `reason_params`.
    """

    reason_params: dict[str, float | int | str | Phrase]
    step: int | None
    steps: int | None
    created_at: AwareDatetime
    started_at: AwareDatetime | None
    ended_at: AwareDatetime | None
    zero_offsets: list[ZeroOffset]


class Event(BaseModel):
    """
    An event; `n` increases from 1, `uid` is the same at every delivery.
    """

    n: int
    uid: str
    type: str
    """
    Today `run.started`, `run.ended`, `alarm`, `station.started`, `station.stopped`.
    """

    at: AwareDatetime
    data: dict[str, Any]


class FieldAtFault(BaseModel):
    """
    One error in a request.
    """

    field: str
    detail: str


class ReadingAnswer(BaseModel):
    """
    One row of the measurement file.
    """

    reading: int
    t_s: float
    theta1_deg: float
    theta2_deg: float
    approach1: int
    approach2: int
    scale_mm: float
    position: str
    walk: int
    temperature_c: float | None
    payload_kg: float | None
    mount: str | None


class StationInfo(BaseModel):
    """
    Identity and capabilities of the station.
    """

    name: str
    emulated: bool
    limits: dict[str, float]
    """
    The options of `[limits]` in the station file.
    """

    plans: list[str]
    """
    Plans that this station can run.
    """

    recommended_plan: str
    """
    The default plan.
    """

    open: bool
    """
    Whether users at this computer have all rights without signing in.
    """


class DeviceView(BaseModel):
    """
    The state of one device.
    """

    name: str
    kind: str
    """
    Today `scale`, `axis`.
    """

    address: str
    state: str
    """
    Today `ok`, `lost`, `fault`, `unknown`.
    """

    text: str


class Trip(BaseModel):
    """
    An interlock that ended a motion.
    """

    run: int
    text: str
    """
    The detected condition.
    """

    stop_frame_ms: float | None
    """
    Time from detection until the stop frames of both drives were sent; null if none was.
    """

    standstill_ms: float
    """
    Time from detection until standstill of both drives was confirmed.
    """


class MachineView(BaseModel):
    """
    Live values, `age_s` old when they were sent.
    """

    theta1_deg: float | None
    theta2_deg: float | None
    x_mm: float | None
    y_mm: float | None
    scale_mm: float | None
    age_s: float | None


class Workspace(BaseModel):
    """
    Limits of the workspace, mm.
    """

    x: Annotated[list[Any], Field(min_length=2)]
    y: Annotated[list[Any], Field(min_length=2)]


class RetractView(BaseModel):
    """
    Whether the arm has to be brought back into its workspace.
    """

    needed: bool
    excess_mm: float | None
    """
    Distance outside the workspace; null if unknown or if the linkage cannot close there.
    """

    text: str


class CalibrationHolds(BaseModel):
    """
    Whether work with the calibration of a robot is permitted.
    """

    robot_serial: str
    locked: bool
    """
    A check has failed, and neither a passed calibration nor an engineer has cleared it.
    """

    text: str
    check: int | None
    """
    The run that determines it.
    """

    calibration_valid_until: AwareDatetime | None
    """
    From the last passed check; null if there is none since the last calibration.
    """


class SequenceTitle(BaseModel):
    """
    The active measurement sequence.
    """

    number: int
    title: str


class RunStop(BaseModel):
    """
    One position of the active sequence.
    """

    position: str
    x_mm: float
    y_mm: float
    done: bool


class RunReading(BaseModel):
    """
    One reading of the active run.
    """

    reading: int
    residual_mm: float | None
    limit_mm: float | None
    position: str
    x_mm: float | None
    y_mm: float | None
    theta1_deg: float
    theta2_deg: float
    scale_mm: float
    sd_mm: float | None
    t_s: float
    walk: int


class Stopped(BaseModel):
    """
    Answer of the drives to the quick stop; an active run is being aborted.
    """

    axes: dict[str, str | None]
    """
    by axis: null when it confirmed, else what went wrong
    """

    confirmed: bool
    """
    whether every axis confirmed; if not, use the emergency stop
    """


class CalibrationBody(BaseModel):
    """
    A calibration request: robot, plan and requester.
    """

    robot_serial: str
    plan: Literal[
        "paper", "rapid", "full", "diagnostic", "adaptive", "check", "reference", "two_mounts", "gauge_study"
    ]
    operator: str
    work_order: str | None = None
    metadata: dict[str, Any] | None = None
    references: list[Annotated[JointAngle | MountingError, Field(discriminator="kind")]] | None = None
    """
    what other instruments measured; for this run
    """

    accuracy_mm: float | None = None
    """
    largest position error that is wanted; else the robot file's
    """

    until_mm: float | None = None
    """
    the same, and plan `adaptive` ends as soon as it is reached
    """

    study: StudyDesign | None = None
    """
    how often plan `gauge_study` calibrates; for that plan alone
    """


class WeakDirection(BaseModel):
    """
    The direction of the zero offsets that the readings determine least.
    """

    singular_ratio: float | None
    text: str
    said: Phrase | None
    """
    The text by its code, for other languages; null in documents of older versions.
    """

    sd_deg: float | None
    """
    Standard uncertainty of the zero offsets along it.
    """

    blind: list[str]
    """
    Directions that no reading can determine.
    """

    blind_said: list[Phrase]
    """
    The same by their codes.
    """

    remedies: list[Remedy]
    remedy: str | None
    """
    The best of them in words.
    """

    remedy_said: Phrase | None
    """
    The same by its code.
    """


class Accuracy(BaseModel):
    """
    Position accuracy of the robot, before or after; for a diagnosis, without its effects or with them.
    """

    reading_rms_mm: float | None
    fresh_reading_rms_mm: float | None
    """
    RMS of readings that were not used in the fit.
    """

    fresh_reading_max_mm: float | None
    predicted_position_error_mm: PositionError | None


class FleetUse(BaseModel):
    """
    Whether the prior from other robots of the type was used.
    """

    used: bool
    p_value: float | None
    """
    p-value of the readings under that prior.
    """

    text: str
    prior: FleetPrior


class Finding(BaseModel):
    """
    One effect that the model lacked.
    """

    effect: str
    joint: int | None
    part: str | None
    """
    The part on which it acts: "L1", "links", "scale", "joint1" and so on.
    """

    label: str
    parameters: list[Quantity]
    share: float
    """
    Share of the base residual's sum of squares that this effect accounts for.
    """

    p_value: float
    probability: float | None
    """
    Probability that the effect or one of its alias set is present; null in schema 1.
    """

    alias_set: list[EffectName]
    """
    The effect and those that these readings cannot distinguish from it.
    """

    remedy: str
    remedy_said: Phrase | None
    """
    The remedy by its code, for other languages; null where there is none, and in older documents.
    """

    separating_experiment: str | None
    separating_experiment_said: Phrase | None
    """
    The same by its code.
    """


class Application(BaseModel):
    """
    The state of a calibration's zero offsets in the drives.
    """

    state: str
    """
    Today `unwritten`, `applied`, `partly`, `in doubt`, `rolled back`, `superseded`.
    """

    verified: bool
    text: str
    joints: list[JointApplication]
    runs: list[ApplicationRun]
    apply_refused: str | None
    """
    Why it cannot be applied, null if it can.
    """

    rollback_refused: str | None
    """
    Why it cannot be rolled back, null if it can.
    """


class MadeBy(BaseModel):
    """
    Stored with a run when it is created, and never changed.
    """

    station: str
    software: str
    """
    Version of this program.
    """

    libraries: dict[str, str]
    """
    Versions of the numerical libraries.
    """

    emulated: bool
    """
    No real machine was measured.
    """

    devices: list[DeviceUsed]
    scale_certificate: ScaleCertificate | None
    """
    None if the station file names none.
    """


class CalibrationList(BaseModel):
    items: list[CalibrationSummary]
    next: int | None
    """
    cursor of the next page, null on the last
    """


class EventList(BaseModel):
    """
    Events in chronological order.
    """

    items: list[Event]
    next: int | None
    """
    `after` of the next page, null when there are no more yet
    """


class Problem(BaseModel):
    """
    RFC 9457 problem document.
    """

    type: str
    """
    `urn:station:problem:<kind>`, or `about:blank` when the status says it all
    """

    title: str
    status: int
    detail: str
    field: str | None = None
    """
    the first field at fault
    """

    errors: list[FieldAtFault] | None = None
    calibration_id: int | None = None
    """
    the run that holds the rig or the key
    """

    said: Phrase | None = None
    """
    `detail` by its code, for other languages
    """

    missing: list[str] | None = None
    """
    what keeps the station from being ready
    """


class ReadingList(BaseModel):
    items: list[ReadingAnswer]
    next: None


class Interlock(BaseModel):
    """
    One condition for motion, before and during it.
    """

    id: str
    text: str
    ok: bool
    detail: str
    """
    The trouble; empty if the condition holds.
    """

    own_text: bool
    """
    Whether `text` is from the station file, to be shown unchanged in every language.
    """

    limits: dict[str, float]
    """
    Limits from the station file, by name with unit, or the defaults.
    """

    shows: str
    """
    The last value with its unit, if there is one.
    """

    last_trip: Trip | None
    """
    Its last trip since the station was started.
    """


class RunView(BaseModel):
    """
    The run that holds the rig.
    """

    id: int
    uid: str
    state: str
    """
    State of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    robot_serial: str
    kind: str
    plan: str
    of: int | None
    operator: str
    work_order: str | None
    started_at: AwareDatetime | None
    elapsed_s: float | None
    remaining_s: float | None
    walk: SequenceTitle | None
    progress: float
    """
    Progress of the whole run, 0 to 1; an estimate that never decreases.
    """

    step: int | None
    steps: int | None
    iterations: list[Iteration]
    prompt: Prompt | None
    """
    The prompt that the run waits for, in state `waiting`.
    """

    stops: list[RunStop]
    readings: list[RunReading]


class Calibration(BaseModel):
    """
    The complete record of one run.
    """

    method: str | None
    parameters: list[Quantity]
    """
    Every identified parameter except the zero offsets.
    """

    weak_direction: WeakDirection | None
    before: Accuracy | None
    """
    Accuracy without compensation.
    """

    after: Accuracy | None
    """
    Accuracy with the identified offsets applied.
    """

    accuracy: AccuracyReached | None
    """
    Predicted position accuracy, with the required one; null if no offsets were identified.
    """

    advice: list[Advice]
    """
    The most effective measures, by gain per minute; only those with a benefit.
    """

    check: CheckFound | None
    """
    Result of a check.
    """

    iterations: list[Iteration]
    residuals: list[Residual]
    """
    Residuals of the readings of the fit.
    """

    memory: MemoryUse | None
    """
    Null if there was no knowledge of this robot before.
    """

    fleet: FleetUse | None
    """
    Null if there was knowledge of this robot, or of no others of its type.
    """

    references: list[ReferenceUse]
    """
    References from other instruments, and how well they agree with the other data.
    """

    lack_of_fit: str | None
    """
    The misfit of the model; null if it fits or was not tested.
    """

    lack_of_fit_reason: Reason | None
    """
    The same by its code, for other languages; null in results of older versions, too.
    """

    findings: list[Finding]
    """
    Effects that the model lacked, strongest first.
    """

    id: int
    uid: str
    """
    UUIDv7; unlike the number, it is unique over all stations, and after a restore.
    """

    robot_serial: str
    kind: str
    """
    Kind of run: `calibrate`, `diagnose`, `separate`, `apply`, `rollback` or `import`.
    """

    plan: str
    """
    Plan of a calibration; otherwise `apply`, `rollback`, `separating` or `dataset`.
    """

    of: int | None
    """
    The run that it belongs to, for instance the one whose offsets it applied.
    """

    operator: str
    work_order: str | None
    state: str
    """
    State of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    verdict: str | None
    outcome: str | None
    """
    Null until the run has ended.
    """

    reason: str | None
    """
    Reason in English.
    """

    reason_code: str | None
    """
    The reason's code for other languages, with `reason_params`.
    """

    reason_params: dict[str, float | int | str | Phrase]
    step: int | None
    steps: int | None
    created_at: AwareDatetime
    started_at: AwareDatetime | None
    ended_at: AwareDatetime | None
    zero_offsets: list[ZeroOffset]
    metadata: dict[str, Any]
    zero_offset_tolerance_deg: float | None
    machine: str
    """
    Model in its robot file.
    """

    prompt: Prompt | None
    """
    The prompt of the run, in state `waiting`.
    """

    application: Application | None
    """
    Null unless the run has passed.
    """

    made_by: MadeBy | None
    """
    Software, devices and scale; null for a run of an earlier version, or one measured elsewhere.
    """


class StationView(BaseModel):
    """
    The complete state of the station; also the `data` of the live feed's snapshot.
    """

    station: StationInfo
    devices: list[DeviceView]
    interlocks: list[Interlock]
    machine: MachineView | None
    """
    Null while the position of the arm is unknown.
    """

    workspace: Workspace
    retract: RetractView
    calibration: CalibrationHolds
    """
    Calibration of the robot measured last.
    """

    run: RunView | None
    last: CalibrationSummary | None
    finished: RunView | None
    """
    The last run with its positions and readings; null while another is active.
    """


Phrase.model_rebuild()
