"""What travels between the rooms: plans to walk, readings taken, states and results.

Records carry ids and units in their names; nothing is matched by order.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import asdict, dataclass, field
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any, Literal

from station.records.quantity import Quantity


class State(StrEnum):
    """Of a calibration run."""

    QUEUED = "queued"
    RUNNING = "running"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    ABORTED = "aborted"
    INTERRUPTED = "interrupted"

    @property
    def ended(self) -> bool:
        return self not in (State.QUEUED, State.RUNNING)


PlanName = Literal["paper", "rapid", "full", "diagnostic"]
RunKind = Literal[PlanName, "apply", "rollback", "separating", "dataset"]
"""What a run does: calibrate by a plan, or write the zeros of an earlier run, or take them back; or go on
from a diagnostic run, to tell look-alikes apart.  A `dataset` was measured elsewhere and came as a file."""


@dataclass(frozen=True, slots=True)
class CalibrationRequest:
    """What the operator or the MES asks for."""

    robot_serial: str
    plan: RunKind
    operator: str
    work_order: str | None = None
    metadata: dict[str, Any] = field(default_factory=dict)
    of: int | None = None
    """The run whose zero offsets are applied or rolled back, or that is gone on from; else None."""


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
class Walk:
    """A sequence of stops to be measured in this order."""

    title: str
    """In the operator's words, e.g. "Measuring, pass 2"."""
    number: int
    """1, 2, ...; stored with each reading of the walk as `pass`."""
    stops: tuple[Stop, ...]


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


@dataclass(frozen=True, slots=True)
class CalibrationResult:
    """What a run ends with; `to_json` is what the store keeps and REST answers.

    `verdict` is "pass" only when every check passed on finite numbers; `reason` says why not.
    """

    verdict: Literal["pass", "fail"]
    reason: str
    method: str
    zero_offsets: tuple[Quantity, ...]
    """dtheta1, dtheta2 in deg: actual minus nominal joint angle."""
    parameters: tuple[Quantity, ...]
    """Every other identified parameter (dr_M, ...), each with its sd."""
    weak_direction: dict[str, Any]
    """{singular_ratio, text, sd_deg, remedy}"""
    before: dict[str, Any]
    """{reading_rms_mm, predicted_position_error_mm: {rms, max}} with no compensation."""
    after: dict[str, Any]
    """The same with the identified offsets applied."""
    iterations: tuple[dict[str, Any], ...]
    """Per pass: {pass, dtheta1_deg, dtheta2_deg, total1_deg, total2_deg, mu_deg}."""
    residuals: tuple[dict[str, Any], ...]
    """Per reading of the fit: {reading, position, residual_mm, limit_mm}."""
    lack_of_fit: str = ""
    """What in the readings the model does not account for, in plain words; empty when it fits."""
    memory: dict[str, Any] | None = None
    """What earlier runs knew: {used, p_value, text, from_calibration, age_days}; None: nothing was known."""
    lasting: dict[str, Any] | None = None
    """`station.identification.memory.Memory` as JSON: what a pass leaves to the robot's next run."""
    findings: tuple[dict[str, Any], ...] = ()
    """Effects that the model lacked, as in the diagnosis document; strongest first."""
    diagnosis: dict[str, Any] | None = None
    """The whole document, schema station.diagnosis/1; None when none was asked for."""

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True, slots=True)
class Remembered:
    """What a passed run left to the robot's next one."""

    calibration_id: int
    at: datetime
    memory: dict[str, Any]
    """`station.identification.memory.Memory` as JSON."""

    @property
    def age_days(self) -> float:
        """Never negative, also when the clock was set back."""
        return max((datetime.now(UTC) - self.at).total_seconds(), 0.0) / 86_400.0

    def to_json(self) -> dict[str, Any]:
        """For people: where it comes from, its age, what is known."""
        names, mean, covariance = (self.memory[key] for key in ("names", "mean", "covariance"))
        return {
            "from_calibration": self.calibration_id,
            "at": self.at.isoformat(timespec="milliseconds").replace("+00:00", "Z"),
            "age_days": round(self.age_days, 3),
            "parameters": [
                {"name": name, "value": mean[i], "sd": math.sqrt(covariance[i][i]), "unit": "mm"}
                for i, name in enumerate(names)
            ],
        }


Procedure = Generator[Walk | SetZeros, Any, CalibrationResult]
"""A method: yields walks and is sent the readings of each, yields zeros and is sent their shifts.

What goes wrong meanwhile is raised where it yielded, so that it may still put something right.  It
never touches a device: the orchestrator walks, stores and sends.
"""
