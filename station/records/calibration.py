"""A run as the history shows it: its summary, and all that is known about it."""

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
    """UUIDv7; other than the number, no other station gives it away, nor this one after a restore."""
    robot_serial: str
    kind: str
    """What the run did: `calibrate`, `diagnose`, `separate`, `apply`, `rollback` or `import`."""
    plan: str
    """Of a calibration; else `apply`, `rollback`, `separating` or `dataset`."""
    of: int | None = None
    """The run that it belongs to, for instance the one whose offsets it applied."""
    operator: str
    work_order: str | None = None
    state: State
    verdict: Verdict | None
    outcome: Outcome | None = None
    """Null until the run has ended."""
    reason: str | None = None
    """In English."""
    reason_code: str | None = None
    """The same for other languages, with `reason_params`."""
    reason_params: dict[str, ReasonValue] = Field(default_factory=dict)
    step: int | None = None
    steps: int | None = None
    created_at: datetime
    started_at: datetime | None = None
    ended_at: datetime | None = None
    zero_offsets: tuple[ZeroOffset, ...] = ()


class JointApplication(Record):
    """One drive: `shift_deg` is how far its frame has moved since the calibration."""

    joint: int
    state: ApplicationState
    old_offset_deg: float
    shift_deg: float | None
    new_offset_deg: float | None
    """What is left of the zero offset in the drive's frame."""


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
    """What the drives hold of a calibration's zero offsets."""

    state: ApplicationState
    verified: bool
    text: str
    joints: tuple[JointApplication, ...]
    runs: tuple[ApplicationRun, ...]
    apply_refused: str | None
    """Why it cannot be applied, null when it can."""
    rollback_refused: str | None
    """Why it cannot be rolled back, null when it can."""


class Calibration(CalibrationSummary, ResultParts):
    """All that is known about one run."""

    metadata: dict[str, JsonValue] = Field(default_factory=dict)
    zero_offset_tolerance_deg: float | None = None
    machine: str = "five-bar"
    """Model of its robot file."""
    prompt: Prompt | None = None
    """What the run asks, in state `waiting`."""
    application: Application | None = None
    """Null unless the run has passed."""
    made_by: MadeBy | None = None
    """Software, devices and scale; null for a run of an earlier version, and one measured elsewhere."""
