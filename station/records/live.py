"""The station at one moment, as the page and the terminal are told of it."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from station.records.calibration import CalibrationSummary
from station.records.prompt import Prompt
from station.records.record import Record
from station.records.result import Iteration
from station.records.run import PlanName, State

DeviceState = Literal["ok", "lost", "fault", "unknown"]


class StationInfo(Record):
    """What the station is and can do."""

    name: str
    emulated: bool
    limits: dict[str, float]
    """The options of `[limits]` in the station file."""
    plans: tuple[PlanName, ...]
    """Plans that this station can run."""
    recommended_plan: PlanName
    """Where nothing speaks for another one."""
    open: bool = False
    """Whether anybody at this computer may do everything without signing in."""


class DeviceView(Record):
    """What is known of one device."""

    name: str
    kind: Literal["scale", "axis"]
    address: str
    state: DeviceState
    text: str = ""


class Trip(Record):
    """An interlock that ended a motion."""

    run: int
    text: str
    """What was noticed."""
    stop_frame_ms: float | None
    """From noticing it until the stop frames of both drives were sent; null where none was."""
    standstill_ms: float
    """From noticing it until both drives were seen to stand."""


class Interlock(Record):
    """One condition that must hold before and during motion."""

    id: str
    text: str
    ok: bool
    detail: str = ""
    """What is wrong; empty when it holds."""
    own_text: bool = False
    """Whether `text` is the station file's, to be shown as it is in every language."""
    limits: dict[str, float] = Field(default_factory=dict)
    """As the station file declares them, by name with unit, or its defaults."""
    shows: str = ""
    """The value that was looked at last, with its unit, where there is one."""
    last_trip: Trip | None = None
    """When it last ended a motion, since the station was started."""

    def without_value(self) -> Interlock:
        """The same without what changes all the time."""
        return self.model_copy(update={"shows": ""})


class MachineView(Record):
    """Live values, `age_s` old when they were sent."""

    theta1_deg: float | None
    theta2_deg: float | None
    x_mm: float | None
    y_mm: float | None
    scale_mm: float | None
    age_s: float | None


class RetractView(Record):
    """Whether the arm has to be brought back into its workspace."""

    needed: bool
    excess_mm: float | None
    """How far outside it stands; null when that is not known or the linkage cannot close there."""
    text: str


class CalibrationHolds(Record):
    """Whether calibrated work of a robot may go on."""

    robot_serial: str
    locked: bool
    """A check has failed, and neither a passed calibration nor an engineer has cleared it."""
    text: str
    check: int | None = None
    """The run that says so."""
    calibration_valid_until: datetime | None = None
    """Of the last passed check; null where there is none since the last calibration."""


class Workspace(Record):
    """Limits of the workspace, mm."""

    x: tuple[float, float]
    y: tuple[float, float]


class SequenceTitle(Record):
    """The measurement sequence under way."""

    number: int
    title: str


class RunStop(Record):
    """One position of the sequence under way."""

    position: str
    x_mm: float
    y_mm: float
    done: bool


class SequenceView(SequenceTitle):
    """A sequence as it begins."""

    stops: tuple[RunStop, ...]


class ResidualOfReading(Record):
    """What an identification says of one reading."""

    reading: int
    residual_mm: float | None = None
    limit_mm: float | None = None


class RunReading(ResidualOfReading):
    """One reading of the run under way."""

    position: str
    x_mm: float | None = None
    y_mm: float | None = None
    theta1_deg: float
    theta2_deg: float
    scale_mm: float
    sd_mm: float | None = None
    t_s: float
    walk: int


class RunBrief(Record):
    """The run that holds the rig, without its positions and readings."""

    id: int
    uid: str
    state: State
    robot_serial: str
    kind: str
    plan: str
    of: int | None = None
    operator: str
    work_order: str | None = None
    started_at: datetime | None = None
    elapsed_s: float | None = None
    remaining_s: float | None = None
    walk: SequenceTitle | None = None
    progress: float = 0.0
    """Of the whole run, 0 to 1; an estimate that never falls."""
    step: int | None = None
    steps: int | None = None
    iterations: tuple[Iteration, ...] = ()
    prompt: Prompt | None = None
    """What the run waits to be told, in state `waiting`."""


class RunView(RunBrief):
    """The run that holds the rig."""

    stops: tuple[RunStop, ...] = ()
    readings: tuple[RunReading, ...] = ()


class StationView(Record):
    """The whole station at one moment; also the `data` of the live feed's snapshot."""

    station: StationInfo
    devices: tuple[DeviceView, ...]
    interlocks: tuple[Interlock, ...]
    machine: MachineView | None
    """Null while it is not known where the arm stands."""
    workspace: Workspace
    retract: RetractView
    calibration: CalibrationHolds
    """Of the robot measured last."""
    run: RunView | None
    last: CalibrationSummary | None
    finished: RunView | None = None
    """The last run with its positions and readings; null while another is under way."""

    def as_open(self, open: bool) -> StationView:
        """The same of a station that is open, or is not."""
        return self.model_copy(update={"station": self.station.model_copy(update={"open": open})})
