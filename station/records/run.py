"""A run: its state, its request, and the steps of its procedure.

Records have ids, and units in their names; nothing is matched by order.
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
    """State of a calibration run."""

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
"""Kinds of runs whose `plan` had another name before kinds had names."""


@dataclass(frozen=True, slots=True)
class CalibrationRequest:
    """A request of the operator or the MES."""

    robot_serial: str
    kind: str
    """Kind of run: a name of `station.run_kinds`."""
    operator: str
    plan: PlanName | None = None
    """Plan of a run that measures by one; otherwise None."""
    work_order: str | None = None
    metadata: dict[str, Any] = field(default_factory=dict)
    of: int | None = None
    """The earlier run that this one refers to or continues; otherwise None."""
    references: tuple[AnyReference, ...] = ()
    """References from other instruments, for this run."""
    until_mm: float | None = None
    """Bound on the largest position error at which plan `adaptive` ends."""
    accuracy_mm: float | None = None
    """Required accuracy: largest position error."""
    study: StudyDesign | None = None
    """Design of plan `gauge_study`; None: the default."""

    @property
    def label(self) -> str:
        """Value of `plan` in REST and the store, also for a run without a plan."""
        return self.plan or _LABELS.get(self.kind, self.kind)


@dataclass(frozen=True, slots=True)
class Submitted:
    """The result of a request; `created` is False if its idempotency key had been used before."""

    id: int
    created: bool


@dataclass(frozen=True, slots=True)
class Stop:
    """One position to measure."""

    position: str
    """Label of the position; stops that share it are repeats or other approaches of one position."""
    target_mm: tuple[float, float]
    """Target position of P, mm in O-xy."""
    theta_deg: tuple[float, float]
    """Joint commands in the drives' nominal frame, compensation already subtracted."""
    approach: tuple[int, int] = (0, 0)
    """Requested sign of each joint's last motion; 0 accepts that of the motion there."""


@dataclass(frozen=True, slots=True)
class MeasurementSequence:
    """A sequence of stops to be measured in this order."""

    title: str
    """Title for the operator, e.g. "Measuring, pass 2"."""
    number: int
    """1, 2, ...; stored with each of its readings."""
    stops: tuple[Stop, ...]
    mount: str | None = None
    """Mounting point of the mechanism; None: at the robot file's `c`."""
    last: bool = False
    """Whether it is the last measurement, as far as known."""


@dataclass(frozen=True, slots=True)
class Ask:
    """A task that only a person can do; the answer is the number, None if none was requested."""

    title: str
    number: int
    text: str
    """The task, in words."""
    kind: PromptKind
    unit: str | None = None
    low: float = -math.inf
    """Smallest possible number."""
    high: float = math.inf
    mounted_at: tuple[float, float] | None = None
    """Mounting point of the mechanism once this is confirmed, mm."""
    mounting: int = 0
    """1, 2, ... if it is remounted there: each mounting has a separate error."""

    def checked(self, value: float | None) -> float | None:
        """The answer, validated. :raises FieldRefused: it is missing, or the number is impossible."""
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
    """New zeros for the drives; the answer is the shift (2) of their frames since run `of`, deg."""

    title: str
    number: int
    of: int
    """The run whose frame the offsets refer to."""
    offsets_deg: tuple[float, float]
    """Zero offset of each joint to be taken out, actual minus nominal angle; 0 restores the old zero."""


@dataclass(frozen=True, slots=True)
class Retract:
    """Return of the arm into the workspace; the answer is how far outside it was, mm."""

    title: str
    number: int


Step = MeasurementSequence | SetZeros | Retract | Ask
"""The possible steps of a procedure."""


@dataclass(frozen=True, slots=True)
class ZeroWrite:
    """One zero written to a drive: theta in the frame before = theta after it + `shift_deg`."""

    id: int
    run_id: int
    of: int
    joint: int
    offset_deg: float
    """The offset to be taken out, see `SetZeros`."""
    from_deg: float
    """Feedback before, in the previous frame."""
    to_deg: float | None
    """Feedback read back."""
    taken: bool | None
    """None: it is unknown whether the drive accepted it."""

    @property
    def shift_deg(self) -> float | None:
        """None while unknown."""
        if self.taken and self.to_deg is not None:
            return self.from_deg - self.to_deg
        return None if self.taken is None else 0.0
