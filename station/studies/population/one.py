"""One machine of a population, calibrated by a plan and verified by fresh readings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.errors import InputRefused
from station.five_bar import SIZE
from station.identification import bounds_mm, fresh_stops, identify, verify
from station.records import PlanName, Real
from station.studies.drawn import drawn, largest_errors_mm, robot_of, stops_of
from station.studies.engine import Engine
from station.studies.population.physics import PlainMachine


@dataclass(frozen=True, slots=True)
class Case:
    """Which machine, made how well, calibrated by what."""

    seed: int
    plan: PlanName
    tolerance_mm: float


@dataclass(frozen=True, slots=True)
class Calibrated:
    """What came of it; rad and mm."""

    off_sd: Real
    """(12,) identified less true, in stated standard uncertainties."""
    zero_error: Real
    """(2,) identified less true zero offset."""
    zero_offset: Real
    """(2,) as identified."""
    largest_mm: float
    """Largest true position error over the workspace with the zeros in the drives only."""
    bound_mm: float
    by_model_mm: float
    """The same with commands of the identified model."""
    bound_by_model_mm: float
    passed: bool
    """The model fitted, and fresh readings were as predicted."""


def population(
    machines: int, seed: int, engine: Engine, plan: PlanName, tolerance_mm: float
) -> list[Calibrated]:
    """Machines drawn by seed; those that the station refuses to identify are left out.

    :raises InputRefused: it refuses all of them; says the last reason.
    """
    cases = [Case(seed * 1_000_003 + k, plan, tolerance_mm) for k in range(machines)]
    found = [one for one in engine.each(calibrated, cases, "Machines") if one is not None]
    if not found:
        raise InputRefused(f"None of {machines} machines could be identified by plan {plan}.")
    return found


def calibrated(case: Case) -> Calibrated | None:
    """None where the station refuses."""
    robot = robot_of(case.tolerance_mm)
    truth = drawn(robot, case.seed)[0].truth
    machine = PlainMachine(robot, truth)
    rng = np.random.default_rng([case.seed, 18])
    try:
        fit = identify(robot, machine.read(stops_of(case.plan, case.tolerance_mm), rng))
    except InputRefused:
        return None
    check = verify(fit, machine.read(fresh_stops(fit), rng))
    bound, bound_by_model = bounds_mm(fit)
    largest, by_model = largest_errors_mm(robot, fit, machine.stand)
    error = fit.p[:SIZE] - truth
    return Calibrated(
        off_sd=error / np.sqrt(np.diag(fit.covariance)[:SIZE]),
        zero_error=error[:2],
        zero_offset=fit.dtheta,
        largest_mm=largest,
        bound_mm=bound,
        by_model_mm=by_model,
        bound_by_model_mm=bound_by_model,
        passed=fit.adequate and check.passed,
    )


def quantiles(values: Sequence[float] | Real) -> dict[str, float]:
    """Of a figure over all machines."""
    found = np.quantile(np.asarray(values), [0.5, 0.95])
    return {"median": float(found[0]), "p95": float(found[1]), "max": float(np.max(values))}
