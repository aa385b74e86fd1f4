"""Requests, procedures and kinds of run for tests."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from station.five_bar.robot_file import Robot
from station.records import CalibrationRequest, CalibrationResult, PlanName, Procedure, Remembered, because
from station.run_kinds import RUN_KINDS, RunKind, kind_of_plan
from station.run_kinds.calibrate import measured_and_verified, published
from station.run_kinds.diagnose import diagnostic

ProcedureFactory = Callable[[PlanName, Robot], Procedure]


def asked(serial: str, what: str, operator: str = "ada", **more: Any) -> CalibrationRequest:
    """A request for a plan or, where `what` is none, for a kind of run."""
    kinds = {plan: kind.name for kind in RUN_KINDS.values() for plan in kind.plans}
    if what in kinds:
        return CalibrationRequest(serial, kinds[what], operator, plan=what, **more)
    return CalibrationRequest(serial, what, operator, **more)


def start_procedure(plan: PlanName, robot: Robot, memory: Remembered | None = None) -> Procedure:
    """The procedure of a plan, without a store."""
    if kind_of_plan(plan) == "diagnose":
        return diagnostic(robot)
    return published(robot) if plan == "paper" else measured_and_verified(plan, robot, memory)


def kinds_with(factory: ProcedureFactory) -> Mapping[str, RunKind]:
    """The kinds of run, with another procedure for runs that measure by a plan."""
    own = {name: kind for name, kind in RUN_KINDS.items() if kind.plans}
    changed = {
        name: replace(kind, procedure=lambda start: factory(start.plan, start.robot))
        for name, kind in own.items()
    }
    return {**RUN_KINDS, **changed}


def result(**fields: Any) -> CalibrationResult:
    """A result, from plain values; a pass by default."""
    usual = {
        "verdict": "pass",
        "outcome": "good",
        "reason": because("converged", passes=2, mu_deg=0.01),
        "method": "published",
        "zero_offsets": (),
    }
    return CalibrationResult.model_validate({**usual, **fields})
