"""What the station takes and answers.  Made by `make reference`; do not edit.

From schemas with SHA-256 33b601e9f752512b0d87f6f4bd29ac4189eaf44508a298225e84aba8e3abef24.
"""

from __future__ import annotations

from datetime import date
from typing import Annotated, Any, Literal

from pydantic import AwareDatetime, BaseModel, Field


class JointAngle(BaseModel):
    """
    The angle of a proximal link, seen by an instrument in the robot's frame while the drive stands.
    """

    kind: Literal["joint_angle"] = "joint_angle"
    joint: Literal[1, 2]
    at_deg: float
    reads_deg: float
    sd_deg: float


class MountingError(BaseModel):
    """
    An error of the mechanism's mounting (MAEMM), measured: of c + d, sideways or in height.
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


class Remedy(BaseModel):
    """
    What would determine a weak direction, and the standard uncertainty of the zero offsets with it.
    """

    text: str
    sd_deg: float


class PositionError(BaseModel):
    """
    Over the workspace or the measured poses, mm.
    """

    rms: float
    max: float
    bound_95: float | None
    """
    With 95 % probability no error is larger; null where only one model was considered.
    """


class AccuracyReached(BaseModel):
    """
    What a calibration promises of positions, beside what was wanted.
    """

    bound_95_mm: float | None
    """
    With 95 % probability no position error over the workspace is larger, with the zeros in the drives
    only: what the robot's own controller will do.
    """

    bound_95_model_mm: float | None
    """
    The same with joint commands computed from the identified model.
    """

    wanted_mm: float | None
    """
    Null where nobody said.
    """

    reached: bool | None
    """
    Whether `bound_95_mm` is what was wanted; null without a wish.
    """

    stopped_because: str | None
    """
    Why no further readings were taken.
    """


class Advice(BaseModel):
    """
    What would make a calibration better.
    """

    kind: str
    """
    `repeat`, `joint_angle`, `drm_x` or `second_mount`.
    """

    text: str
    joint: int | None
    """
    Of a joint angle: whose.
    """

    gain_mm: float
    """
    By how much the bound on the largest position error would fall, with the zeros in the drives only.
    """

    minutes: float


class CheckFound(BaseModel):
    """
    How small a shift of the zeros a check would have found, and what it found.
    """

    smallest_shift_deg: float
    """
    A shift of either zero of this size is found with 99 % probability.
    """

    smallest_by_joint_deg: Annotated[list[Any], Field(min_length=2)]
    shift_deg: Annotated[list[Any], Field(min_length=2)]
    """
    The shift of each zero that explains the readings best.
    """

    p_value: float
    """
    Of the readings, if nothing has changed.
    """

    blind: str
    """
    The direction of both zeros together in which a shift shows least.
    """

    blind_shift_deg: float
    """
    The shift that is found along it.
    """

    valid_until: AwareDatetime | None
    """
    Until when the check holds; null when it failed.
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
    Measured less predicted, of one reading.
    """

    reading: int
    position: str | None
    residual_mm: float | None
    limit_mm: float | None


class MemoryUse(BaseModel):
    """
    Whether what earlier runs know of geometry and mechanism took part.
    """

    used: bool
    p_value: float | None
    """
    Of the readings under the memory.
    """

    text: str
    from_calibration: int
    age_days: float | None


class FleetPrior(BaseModel):
    """
    Geometry of a robot as others of its type let expect it, before it is measured: mm and mm^2.
    """

    type: str
    """
    As the robot files name it.
    """

    serials: list[str]
    """
    Of those others.
    """

    names: list[str]
    mean: list[float]
    covariance: list[list[float]]


class ReferenceUse(BaseModel):
    """
    A reference that took part in a fit, and how well everything else agrees with it.
    """

    reference: Annotated[JointAngle | MountingError, Field(discriminator="kind")]
    residual: float | None
    """
    Reference less what everything else says, in the unit of the parameter; null when nothing else says
    anything of it.
    """

    sd: float | None
    """
    Standard uncertainty of that difference.
    """

    unit: str
    p_value: float | None
    """
    Of a difference that large, if both are right; null where that was not judged.
    """


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


class Phrase(BaseModel):
    """
    `code` is a template in `station.messages`; every language says it from the same parameters.
    """

    code: str
    params: dict[str, float | int | str | Phrase | list[str | Phrase]]
    """
    Numbers, names of columns and keys, other phrases, or several of these, which are joined by "and".
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
    To be given with the answer.
    """

    text: str
    kind: str
    """
    Whether a number is asked for.  Today `confirm`, `number`.
    """

    unit: str | None
    expires_at: AwareDatetime
    """
    Without an answer the run ends then.
    """


class JointApplication(BaseModel):
    """
    One drive: `shift_deg` is how far its frame has moved since the calibration.
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
    What is left of the zero offset in the drive's frame.
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
    Of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    verdict: str | None
    reason: str | None
    ended_at: AwareDatetime | None


class DeviceUsed(BaseModel):
    """
    One device as the station file names it.
    """

    name: str
    driver: str
    address: str


class ScaleCertificate(BaseModel):
    """
    The calibration certificate of the linear scale, as the station file states it.
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
    Who calibrated it.
    """

    calibrated: date
    """
    The day on which it was.
    """

    due: date
    """
    The last day on which it counts.
    """

    u95_um: float
    """
    Expanded uncertainty (k = 2) of a length, the part that does not depend on it, um.
    """

    u95_um_per_m: float
    """
    The part in proportion to the length, um/m.
    """

    expansion_ppm_per_k: float
    """
    Linear expansion of the scale.
    """

    temperature_c: float
    """
    Of the scale at its place of work; readings that carry a temperature state their own.
    """

    temperature_within_k: float
    """
    The temperature lies within this of what is stated; every value is equally likely (GUM, 4.3.7).
    """


class CalibrationSummary(BaseModel):
    """
    One line of the history.
    """

    id: int
    uid: str
    """
    UUIDv7; other than the number, no other station gives it away, nor this one after a restore.
    """

    robot_serial: str
    kind: str
    """
    What the run did: `calibrate`, `diagnose`, `separate`, `apply`, `rollback` or `import`.
    """

    plan: str
    """
    Of a calibration; else `apply`, `rollback`, `separating` or `dataset`.
    """

    of: int | None
    """
    The run that it belongs to, for instance the one whose offsets it applied.
    """

    operator: str
    work_order: str | None
    state: str
    """
    Of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    verdict: str | None
    outcome: str | None
    """
    Null until the run has ended.
    """

    reason: str | None
    """
    In English.
    """

    reason_code: str | None
    """
    The same for other languages, with `reason_params`.
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
    Something that happened; `n` rises from 1 without gaps, `uid` is the same at every delivery.
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
    One thing wrong with a request.
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
    What the station is and can do.
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
    Where nothing speaks for another one.
    """

    open: bool
    """
    Whether anybody at this computer may do everything without signing in.
    """


class DeviceView(BaseModel):
    """
    What is known of one device.
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
    What was noticed.
    """

    stop_frame_ms: float | None
    """
    From noticing it until the stop frames of both drives were sent; null where none was.
    """

    standstill_ms: float
    """
    From noticing it until both drives were seen to stand.
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
    How far outside it stands; null when that is not known or the linkage cannot close there.
    """

    text: str


class CalibrationHolds(BaseModel):
    """
    Whether calibrated work of a robot may go on.
    """

    robot_serial: str
    locked: bool
    """
    A check has failed, and neither a passed calibration nor an engineer has cleared it.
    """

    text: str
    check: int | None
    """
    The run that says so.
    """

    calibration_valid_until: AwareDatetime | None
    """
    Of the last passed check; null where there is none since the last calibration.
    """


class SequenceTitle(BaseModel):
    """
    The measurement sequence under way.
    """

    number: int
    title: str


class RunStop(BaseModel):
    """
    One position of the sequence under way.
    """

    position: str
    x_mm: float
    y_mm: float
    done: bool


class RunReading(BaseModel):
    """
    One reading of the run under way.
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
    What the drives answered to the quick stop; a run under way is being aborted.
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
    What to calibrate, how, and who asks.
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
    sd_deg: float | None
    """
    Standard uncertainty of the zero offsets along it.
    """

    blind: list[str]
    """
    Directions that no reading can see.
    """

    remedies: list[Remedy]
    remedy: str | None
    """
    The best of them in words.
    """


class Accuracy(BaseModel):
    """
    How well the robot positions, before or after; of a diagnosis, without its effects or with them.
    """

    reading_rms_mm: float | None
    fresh_reading_rms_mm: float | None
    """
    Of readings that took no part in the fit.
    """

    fresh_reading_max_mm: float | None
    predicted_position_error_mm: PositionError | None


class FleetUse(BaseModel):
    """
    Whether what other robots of the type showed took part.
    """

    used: bool
    p_value: float | None
    """
    Of the readings under that prior.
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
    Of the base residual's square that this effect accounts for.
    """

    p_value: float
    probability: float | None
    """
    That the effect or one of its alias set is there; null in schema 1.
    """

    alias_set: list[EffectName]
    """
    The effect with those that these readings cannot distinguish from it.
    """

    remedy: str
    separating_experiment: str | None


class Application(BaseModel):
    """
    What the drives hold of a calibration's zero offsets.
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
    Why it cannot be applied, null when it can.
    """

    rollback_refused: str | None
    """
    Why it cannot be rolled back, null when it can.
    """


class MadeBy(BaseModel):
    """
    Kept with a run when it is created, and never changed.
    """

    station: str
    software: str
    """
    Version of this program.
    """

    libraries: dict[str, str]
    """
    Versions of what computes.
    """

    emulated: bool
    """
    No real machine was measured.
    """

    devices: list[DeviceUsed]
    scale_certificate: ScaleCertificate | None
    """
    None where the station file names none.
    """


class CalibrationList(BaseModel):
    items: list[CalibrationSummary]
    next: int | None
    """
    cursor of the next page, null on the last
    """


class EventList(BaseModel):
    """
    Events in the order in which they happened.
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

    missing: list[str] | None = None
    """
    what keeps the station from being ready
    """


class ReadingList(BaseModel):
    items: list[ReadingAnswer]
    next: None


class Interlock(BaseModel):
    """
    One condition that must hold before and during motion.
    """

    id: str
    text: str
    ok: bool
    detail: str
    """
    What is wrong; empty when it holds.
    """

    own_text: bool
    """
    Whether `text` is the station file's, to be shown as it is in every language.
    """

    limits: dict[str, float]
    """
    As the station file declares them, by name with unit, or its defaults.
    """

    shows: str
    """
    The value that was looked at last, with its unit, where there is one.
    """

    last_trip: Trip | None
    """
    When it last ended a motion, since the station was started.
    """


class RunView(BaseModel):
    """
    The run that holds the rig.
    """

    id: int
    uid: str
    state: str
    """
    Of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
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
    Of the whole run, 0 to 1; an estimate that never falls.
    """

    step: int | None
    steps: int | None
    iterations: list[Iteration]
    prompt: Prompt | None
    """
    What the run waits to be told, in state `waiting`.
    """

    stops: list[RunStop]
    readings: list[RunReading]


class Calibration(BaseModel):
    """
    All that is known about one run.
    """

    method: str | None
    parameters: list[Quantity]
    """
    Every identified parameter but the zero offsets.
    """

    weak_direction: WeakDirection | None
    before: Accuracy | None
    """
    With no compensation.
    """

    after: Accuracy | None
    """
    With the identified offsets applied.
    """

    accuracy: AccuracyReached | None
    """
    What is promised of positions, beside what was wanted; null where no offsets were identified.
    """

    advice: list[Advice]
    """
    What would help most, by gain per minute; only what helps.
    """

    check: CheckFound | None
    """
    Of a check.
    """

    iterations: list[Iteration]
    residuals: list[Residual]
    """
    Of the readings of the fit.
    """

    memory: MemoryUse | None
    """
    Null when nothing was known of this robot before.
    """

    fleet: FleetUse | None
    """
    Null when this robot was known, or no others of its type were.
    """

    references: list[ReferenceUse]
    """
    What other instruments measured, and how well it agrees with the rest.
    """

    lack_of_fit: str | None
    """
    What the model does not account for; null when it fits or none was judged.
    """

    findings: list[Finding]
    """
    Effects that the model lacked, strongest first.
    """

    id: int
    uid: str
    """
    UUIDv7; other than the number, no other station gives it away, nor this one after a restore.
    """

    robot_serial: str
    kind: str
    """
    What the run did: `calibrate`, `diagnose`, `separate`, `apply`, `rollback` or `import`.
    """

    plan: str
    """
    Of a calibration; else `apply`, `rollback`, `separating` or `dataset`.
    """

    of: int | None
    """
    The run that it belongs to, for instance the one whose offsets it applied.
    """

    operator: str
    work_order: str | None
    state: str
    """
    Of a calibration run.  Today `queued`, `running`, `waiting`, `succeeded`, `failed`, `aborted`, `interrupted`.
    """

    verdict: str | None
    outcome: str | None
    """
    Null until the run has ended.
    """

    reason: str | None
    """
    In English.
    """

    reason_code: str | None
    """
    The same for other languages, with `reason_params`.
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
    Model of its robot file.
    """

    prompt: Prompt | None
    """
    What the run asks, in state `waiting`.
    """

    application: Application | None
    """
    Null unless the run has passed.
    """

    made_by: MadeBy | None
    """
    Software, devices and scale; null for a run of an earlier version, and one measured elsewhere.
    """


class StationView(BaseModel):
    """
    The whole station at one moment; also the `data` of the live feed's snapshot.
    """

    station: StationInfo
    devices: list[DeviceView]
    interlocks: list[Interlock]
    machine: MachineView | None
    """
    Null while it is not known where the arm stands.
    """

    workspace: Workspace
    retract: RetractView
    calibration: CalibrationHolds
    """
    Of the robot measured last.
    """

    run: RunView | None
    last: CalibrationSummary | None
    finished: RunView | None
    """
    The last run with its positions and readings; null while another is under way.
    """


Phrase.model_rebuild()
