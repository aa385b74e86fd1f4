"""A run: its state, what was asked for, and the steps that its procedure takes.

Records carry ids and units in their names; nothing is matched by order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Literal

from station.errors import FieldRefused
from station.records.references import AnyReference
from station.records.study_design import StudyDesign


class State(StrEnum):
    """Of a calibration run."""

    QUEUED = "queued"
    RUNNING = "running"
    WAITING = "waiting"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    ABORTED = "aborted"
    INTERRUPTED = "interrupted"

    @property
    def ended(self) -> bool:
        return self not in (State.QUEUED, State.RUNNING, State.WAITING)


PromptKind = Literal["confirm", "number"]


PlanName = str
"""A name of `station.plans.PLANS`."""

_LABELS = {"separate": "separating", "import": "dataset"}
"""Kinds of run whose `plan` had another name before kinds had names."""


@dataclass(frozen=True, slots=True)
class CalibrationRequest:
    """What the operator or the MES asks for."""

    robot_serial: str
    kind: str
    """What the run is to do: a name of `station.run_kinds`."""
    operator: str
    plan: PlanName | None = None
    """Of a run that measures by a plan; else None."""
    work_order: str | None = None
    metadata: dict[str, Any] = field(default_factory=dict)
    of: int | None = None
    """The earlier run that this one is about or continues; else None."""
    references: tuple[AnyReference, ...] = ()
    """What other instruments say, for this run."""
    until_mm: float | None = None
    """Bound on the largest position error at which plan `adaptive` ends."""
    accuracy_mm: float | None = None
    """Largest position error that is wanted."""
    study: StudyDesign | None = None
    """How often plan `gauge_study` calibrates; None: as usual."""

    @property
    def label(self) -> str:
        """What REST and the store show as `plan`, also of a run that measures by none."""
        return self.plan or _LABELS.get(self.kind, self.kind)


@dataclass(frozen=True, slots=True)
class Submitted:
    """What a request came to; `created` is False when its idempotency key had been used before."""

    id: int
    created: bool


@dataclass(frozen=True, slots=True)
class Stop:
    """One place to measure at."""

    position: str
    """Label of the place; stops that share it are repeats or other approaches of one place."""
    target_mm: tuple[float, float]
    """Where P is meant to be, mm in O-xy."""
    theta_deg: tuple[float, float]
    """Joint commands in the drives' nominal frame, compensation already subtracted."""
    approach: tuple[int, int] = (0, 0)
    """Wanted sign of each joint's last motion; 0 leaves it to the way there."""


@dataclass(frozen=True, slots=True)
class MeasurementSequence:
    """A sequence of stops to be measured in this order."""

    title: str
    """In the operator's words, e.g. "Measuring, pass 2"."""
    number: int
    """1, 2, ...; stored with each of its readings."""
    stops: tuple[Stop, ...]
    mount: str | None = None
    """Where the mechanism is mounted; None: at the robot file's `c`."""
    last: bool = False
    """Whether nothing is measured after it, as far as can be known."""


@dataclass(frozen=True, slots=True)
class Ask:
    """Something that only a person can do or see; answered with the number, None where none was asked for."""

    title: str
    number: int
    text: str
    """What to do, in words."""
    kind: PromptKind
    unit: str | None = None
    low: float = -math.inf
    """Smallest number that can be."""
    high: float = math.inf
    mounted_at: tuple[float, float] | None = None
    """Where the mechanism is mounted once this is confirmed, mm."""
    mounting: int = 0
    """1, 2, ... where it is mounted there once more: each time it has an error of its own."""

    def checked(self, value: float | None) -> float | None:
        """An answer that can be.  :raises FieldRefused: it is missing, or no such number can be."""
        if self.kind == "confirm":
            return None
        if value is None:
            raise FieldRefused("value", f"A number is asked for, in {self.unit}.")
        if not (math.isfinite(value) and self.low <= value <= self.high):
            raise FieldRefused(
                "value",
                f"{value:g} {self.unit} cannot be; between {self.low:g} and {self.high:g} is expected.",
            )
        return value


@dataclass(frozen=True, slots=True)
class SetZeros:
    """Drives to be given new zeros; answered with the shift (2) of their frames since run `of`, deg."""

    title: str
    number: int
    of: int
    """The run in whose frame the offsets are meant."""
    offsets_deg: tuple[float, float]
    """Zero offset of each joint to be taken out, actual minus nominal angle; 0 puts the old zero back."""


@dataclass(frozen=True, slots=True)
class Retract:
    """The arm to be brought back into the workspace; answered with how far outside it stood, mm."""

    title: str
    number: int


Step = MeasurementSequence | SetZeros | Retract | Ask
"""What a procedure may ask for."""


@dataclass(frozen=True, slots=True)
class ZeroWrite:
    """One zero written to a drive: theta in the frame before = theta after it + `shift_deg`."""

    id: int
    run_id: int
    of: int
    joint: int
    offset_deg: float
    """What it was to take out, see `SetZeros`."""
    from_deg: float
    """Feedback before, in the frame until then."""
    to_deg: float | None
    """Feedback read back."""
    taken: bool | None
    """None: the drive may or may not have taken it."""

    @property
    def shift_deg(self) -> float | None:
        """None while it is not known."""
        if self.taken and self.to_deg is not None:
            return self.from_deg - self.to_deg
        return None if self.taken is None else 0.0
