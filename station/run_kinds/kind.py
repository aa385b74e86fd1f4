"""The definition of a run kind, and the register of all kinds.

A further kind is one module that registers itself (docs/how-to/add-a-run-kind.md): its checks, its procedure
and, in `station.messages`, its texts.  The orchestrator refers to none by name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from types import MappingProxyType

from station.five_bar import Robot
from station.plans import PLANS, Pace
from station.records import (
    Asked,
    Beforehand,
    Calibration,
    CalibrationRequest,
    CalibrationResult,
    CalibrationSummary,
    PlanName,
    Procedure,
    Reading,
)
from station.settings import LimitSettings
from station.store import Store


@dataclass(frozen=True, slots=True)
class Start:
    """The input of a procedure."""

    store: Store
    request: CalibrationRequest
    robot: Robot
    began_at: datetime | None = None
    """The station's clock when the run was created; None is now."""
    limits: LimitSettings = field(default_factory=LimitSettings)
    """Limits of this station."""
    known_before: Callable[[], Beforehand | None] | None = None
    """The knowledge before a finished run that is evaluated again; None: the current one in the store."""

    @property
    def pace(self) -> Pace:
        """The speed of this station."""
        return Pace.of(self.limits)

    @property
    def of(self) -> int:
        """The earlier run that this one refers to. Only for kinds that refer to one."""
        if self.request.of is None:
            raise ValueError(f"a run of kind {self.request.kind} names no earlier run")
        return self.request.of

    @property
    def plan(self) -> PlanName:
        """The plan to measure by.  Only for kinds that have plans."""
        if self.request.plan is None:
            raise ValueError(f"a run of kind {self.request.kind} names no plan")
        return self.request.plan

    @property
    def wanted_mm(self) -> float | None:
        """Required accuracy: largest position error; None if not specified."""
        request = self.request
        return request.until_mm or request.accuracy_mm or self.robot.accuracy_mm


@dataclass(frozen=True, slots=True)
class Continued:
    """Data from an earlier run that a run continues: its readings, and its clock."""

    readings: list[Reading]
    elapsed_s: float
    """Real time since the earlier run started."""


def _nothing_to_check(store: Store, request: CalibrationRequest) -> None:
    return None


@dataclass(frozen=True)
class RunKind:
    """One kind of run."""

    name: str
    procedure: Callable[[Start], Procedure] | None
    """Makes the procedure, not yet started; None where nothing is measured on the rig.

    :raises InputRefused: it is not possible for this robot.
    """
    concluded: Callable[[Start, list[Reading]], CalibrationResult] | None = None
    """The result of all readings of a complete run at once, without its procedure; None: the result needs
    the steps. :raises InputRefused: the readings cannot be judged."""
    check: Callable[[Store, CalibrationRequest], None] = _nothing_to_check
    """Check before storing anything. :raises NotApplicable: the earlier run does not permit it."""
    done_by: Callable[[Store, int], int | None] | None = None
    """The run that has already done this for an earlier run, so that a repeated request is harmless."""
    continues: Callable[[Store, CalibrationRequest], Continued | None] | None = None
    """The data taken over from the earlier run before anything moves; None: nothing."""
    from_outside: bool = False
    """Whether it may start with the arm outside its workspace, or without a valid scale reading."""
    judged: bool = True
    """Whether it ends with a verdict on the robot."""
    rests_on_scale: bool = True
    """Whether its verdict needs a certified scale; not for kinds that only write the zeros of a pass."""
    offsets: bool = False
    """Whether the zero offsets of a pass may be written to the drives."""

    @property
    def plans(self) -> tuple[PlanName, ...]:
        """Plans that this kind measures by; a start request that names one of them is of this kind."""
        return tuple(plan.name for plan in PLANS.values() if plan.run_kind == self.name)


def robot_as_measured(store: Store, calibration: Calibration) -> Robot:
    """The robot file of a finished run, with the references that it was started with.

    :raises NotFound: no such run.
    """
    robot = store.robot_of(calibration.id)
    own = [use.reference for use in calibration.references if use.reference not in robot.references]
    return robot.informed(own)


_KINDS: dict[str, RunKind] = {}
RUN_KINDS: Mapping[str, RunKind] = MappingProxyType(_KINDS)
"""Every kind by its name."""


def register(kind: RunKind) -> RunKind:
    """Register a kind. :raises ValueError: its name is in use."""
    if kind.name in _KINDS:
        raise ValueError(f"the run kind {kind.name} is registered already")
    _KINDS[kind.name] = kind
    return kind


def kind_of_plan(plan: PlanName) -> str:
    """The name of the kind that measures by a plan."""
    return PLANS[plan].run_kind


def has_offsets(run: CalibrationSummary) -> bool:
    """Whether a pass of its kind has zero offsets to write; the history may contain former kinds."""
    kind = RUN_KINDS.get(run.kind)
    return kind is not None and kind.offsets


def request_of(store: Store, run: int) -> CalibrationRequest:
    """The request that a run was started with.  :raises NotFound: no such run."""
    known = store.calibration(run)
    plan = known.plan if RUN_KINDS[known.kind].plans else None
    asked = next((event.data for event in store.events(run) if event.kind == "asked"), {})
    more = Asked.model_validate(asked)
    return CalibrationRequest(
        known.robot_serial,
        known.kind,
        known.operator,
        plan=plan,
        of=known.of,
        work_order=known.work_order,
        metadata=known.metadata,
        references=more.references,
        until_mm=more.until_mm,
        accuracy_mm=more.accuracy_mm,
        study=more.study,
    )
