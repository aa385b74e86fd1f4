"""A run as the history shows it: its summary, and its complete record."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field, JsonValue

from station.records.made_by import MadeBy
from station.records.prompt import Prompt
from station.records.reason import ReasonValue
from station.records.record import Record
from station.records.result import Outcome, ResultParts, Verdict, ZeroOffset
from station.records.run import State

ApplicationState = Literal["unwritten", "applied", "partly", "in doubt", "rolled back", "superseded"]


class CalibrationSummary(Record):
    """One line of the history."""

    id: int
    uid: str
    """UUIDv7; unlike the number, it is unique over all stations, and after a restore."""
    robot_serial: str
    kind: str
    """Kind of run: `calibrate`, `diagnose`, `separate`, `apply`, `rollback` or `import`."""
    plan: str
    """Plan of a calibration; otherwise `apply`, `rollback`, `separating` or `dataset`."""
    of: int | None = None
    """The run that it belongs to, for instance the one whose offsets it applied."""
    operator: str
    work_order: str | None = None
    state: State
    verdict: Verdict | None
    outcome: Outcome | None = None
    """Null until the run has ended."""
    reason: str | None = None
    """Reason in English."""
    reason_code: str | None = None
    """The reason's code for other languages, with `reason_params`."""
    reason_params: dict[str, ReasonValue] = Field(default_factory=dict)
    step: int | None = None
    steps: int | None = None
    created_at: datetime
    started_at: datetime | None = None
    ended_at: datetime | None = None
    zero_offsets: tuple[ZeroOffset, ...] = ()


class JointApplication(Record):
    """One drive: `shift_deg` is the movement of its frame since the calibration."""

    joint: int
    state: ApplicationState
    old_offset_deg: float
    shift_deg: float | None
    new_offset_deg: float | None
    """The remaining zero offset in the drive's frame."""


class ApplicationRun(Record):
    """One attempt to apply or to roll back."""

    id: int
    plan: Literal["apply", "rollback"]
    operator: str
    state: State
    verdict: Verdict | None
    reason: str | None
    ended_at: datetime | None


class Application(Record):
    """The state of a calibration's zero offsets in the drives."""

    state: ApplicationState
    verified: bool
    text: str
    joints: tuple[JointApplication, ...]
    runs: tuple[ApplicationRun, ...]
    apply_refused: str | None
    """Why it cannot be applied, null if it can."""
    rollback_refused: str | None
    """Why it cannot be rolled back, null if it can."""


class Calibration(CalibrationSummary, ResultParts):
    """The complete record of one run."""

    metadata: dict[str, JsonValue] = Field(default_factory=dict)
    zero_offset_tolerance_deg: float | None = None
    machine: str = "five-bar"
    """Model in its robot file."""
    prompt: Prompt | None = None
    """The prompt of the run, in state `waiting`."""
    application: Application | None = None
    """Null unless the run has passed."""
    made_by: MadeBy | None = None
    """Software, devices and scale; null for a run of an earlier version, or one measured elsewhere."""
