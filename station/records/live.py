"""The current state of the station, for the page and the terminal."""

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
    """Identity and capabilities of the station."""

    name: str
    emulated: bool
    limits: dict[str, float]
    """The options of `[limits]` in the station file."""
    plans: tuple[PlanName, ...]
    """Plans that this station can run."""
    recommended_plan: PlanName
    """The default plan."""
    open: bool = False
    """Whether users at this computer have all rights without signing in."""


class DeviceView(Record):
    """The state of one device."""

    name: str
    kind: Literal["scale", "axis"]
    address: str
    state: DeviceState
    text: str = ""


class Trip(Record):
    """An interlock that ended a motion."""

    run: int
    text: str
    """The detected condition."""
    stop_frame_ms: float | None
    """Time from detection until the stop frames of both drives were sent; null if none was."""
    standstill_ms: float
    """Time from detection until standstill of both drives was confirmed."""


class Interlock(Record):
    """One condition for motion, before and during it."""

    id: str
    text: str
    ok: bool
    detail: str = ""
    """The trouble; empty if the condition holds."""
    own_text: bool = False
    """Whether `text` is from the station file, to be shown unchanged in every language."""
    limits: dict[str, float] = Field(default_factory=dict)
    """Limits from the station file, by name with unit, or the defaults."""
    shows: str = ""
    """The last value with its unit, if there is one."""
    last_trip: Trip | None = None
    """Its last trip since the station was started."""

    def without_value(self) -> Interlock:
        """The same without values that change continuously."""
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
    """Distance outside the workspace; null if unknown or if the linkage cannot close there."""
    text: str


class CalibrationHolds(Record):
    """Whether work with the calibration of a robot is permitted."""

    robot_serial: str
    locked: bool
    """A check has failed, and neither a passed calibration nor an engineer has cleared it."""
    text: str
    check: int | None = None
    """The run that determines it."""
    calibration_valid_until: datetime | None = None
    """From the last passed check; null if there is none since the last calibration."""


class Workspace(Record):
    """Limits of the workspace, mm."""

    x: tuple[float, float]
    y: tuple[float, float]


class SequenceTitle(Record):
    """The active measurement sequence."""

    number: int
    title: str


class RunStop(Record):
    """One position of the active sequence."""

    position: str
    x_mm: float
    y_mm: float
    done: bool


class SequenceView(SequenceTitle):
    """A sequence at its beginning."""

    stops: tuple[RunStop, ...]


class ResidualOfReading(Record):
    """The result of an identification for one reading."""

    reading: int
    residual_mm: float | None = None
    limit_mm: float | None = None


class RunReading(ResidualOfReading):
    """One reading of the active run."""

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
    """Progress of the whole run, 0 to 1; an estimate that never decreases."""
    step: int | None = None
    steps: int | None = None
    iterations: tuple[Iteration, ...] = ()
    prompt: Prompt | None = None
    """The prompt that the run waits for, in state `waiting`."""


class RunView(RunBrief):
    """The run that holds the rig."""

    stops: tuple[RunStop, ...] = ()
    readings: tuple[RunReading, ...] = ()


class StationView(Record):
    """The complete state of the station; also the `data` of the live feed's snapshot."""

    station: StationInfo
    devices: tuple[DeviceView, ...]
    interlocks: tuple[Interlock, ...]
    machine: MachineView | None
    """Null while the position of the arm is unknown."""
    workspace: Workspace
    retract: RetractView
    calibration: CalibrationHolds
    """Calibration of the robot measured last."""
    run: RunView | None
    last: CalibrationSummary | None
    finished: RunView | None = None
    """The last run with its positions and readings; null while another is active."""

    def as_open(self, open: bool) -> StationView:
        """The same for a station that is open, or not."""
        return self.model_copy(update={"station": self.station.model_copy(update={"open": open})})
