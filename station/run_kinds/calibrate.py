"""A calibration: measure by a plan, identify, verify with readings that were not used in the fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import chdtrc

from station.errors import InputRefused
from station.five_bar import Robot
from station.identification import (
    PLAN_ENDED,
    Verification,
    accuracy_of,
    fresh_stops_of,
    prediction_fault,
    with_accuracy,
    without_jump,
)
from station.plans import make_plan
from station.published import MAX_PASSES, PublishedRun
from station.records import (
    AccuracyReached,
    Beforehand,
    CalibrationResult,
    MeasurementSequence,
    PlanName,
    Procedure,
    Reading,
    because,
)
from station.run_kinds.adaptive import adaptive_run
from station.run_kinds.beforehand import known_before
from station.run_kinds.fits import fit_of
from station.run_kinds.guided import reference, two_mounts
from station.run_kinds.kind import RunKind, Start, register
from station.run_kinds.verified import identified_and_verified


def calibrate(start: Start) -> Procedure:
    """The procedure of a plan, not yet started.

    :raises InputRefused: the plan cannot be made for this robot.
    """
    if start.plan == "paper":  # the published method does not use knowledge from earlier runs
        return published(start.robot, start.wanted_mm)
    memory = start.known_before() if start.known_before else known_before(start)
    if guided := GUIDED.get(start.plan):
        return guided(start, memory)
    if start.plan == "adaptive":
        return adaptive_run(start.robot, memory, start.wanted_mm, start.pace)
    # a finished run is evaluated again for its verdict, and advice is most of the work
    again = start.known_before is not None
    return measured_and_verified(start.plan, start.robot, memory, start.wanted_mm, advised=not again)


def published(robot: Robot, wanted_mm: float | None = None) -> Procedure:
    """Sections 4 and 5: measure, identify, compensate, repeat until mu < mu_0 (eq. 32, 33); then verify."""
    run = PublishedRun(robot)
    everything: list[Reading] = []
    for number in range(1, MAX_PASSES + 1):
        stops = make_plan("paper", robot, run.total).stops
        readings: list[Reading] = yield MeasurementSequence(f"Measuring, pass {number}", number, stops)
        run.absorb(readings)
        everything += readings
        if run.converged:
            break
    result = run.result()
    if result.outcome != "not_verified":
        return without_jump(result, robot, everything)
    stops = fresh_stops_of(robot, run.total, seed=len(everything))
    fresh: list[Reading] = yield MeasurementSequence(
        "Verifying at fresh positions", number + 1, stops, last=True
    )
    result = without_jump(_verified(run, result, fresh), robot, [*everything, *fresh])
    return with_accuracy(result, _published_accuracy(run, everything, wanted_mm))


def _published_accuracy(
    run: PublishedRun, readings: list[Reading], wanted_mm: float | None
) -> AccuracyReached:
    """The predicted accuracy of the published offsets, from the measurement model on the same readings."""
    try:
        fit = fit_of(run.robot, passes_apart(readings), None, 0.0)
    except InputRefused:
        return AccuracyReached.of(None, None, wanted_mm, PLAN_ENDED)
    return accuracy_of(fit, wanted_mm, zeros=run.total)


def passes_apart(readings: list[Reading]) -> list[Reading]:
    """For plan `paper`: a position's passes have different angles and are no repeats."""
    return [replace(r, position=f"{r.position} pass {r.sequence}") for r in readings]


def _verified(run: PublishedRun, result: CalibrationResult, fresh: list[Reading]) -> CalibrationResult:
    """A pass if fresh readings agree with the prediction of the result."""
    residual, covariance = run.predicted(fresh)
    square = float(residual @ np.linalg.solve(covariance, residual))
    check = Verification(residual, np.sqrt(np.diag(covariance)), float(chdtrc(len(residual), square)))
    fault = prediction_fault(check)
    converged = because("converged", passes=len(result.iterations), mu_deg=run.mu_deg or 0.0)
    assert result.after is not None
    after = result.after.model_copy(
        update={"fresh_reading_rms_mm": check.rms_mm, "fresh_reading_max_mm": float(np.abs(residual).max())}
    )
    return result.model_copy(
        update={
            "verdict": "fail" if fault else "pass",
            "outcome": "unexplained" if fault else "good",
            "reason": fault or converged,
            "after": after,
            "lack_of_fit": fault.text if fault else None,
            "lack_of_fit_reason": fault,
        }
    )


def measured_and_verified(
    plan: PlanName,
    robot: Robot,
    memory: Beforehand | None = None,
    wanted_mm: float | None = None,
    *,
    advised: bool = True,
) -> Procedure:
    """The measurement model on a chosen plan, then fresh positions that are not used in the fit.

    :param advised: whether to list measures that would improve the calibration
    """
    readings: list[Reading] = yield MeasurementSequence("Measuring", 1, make_plan(plan, robot).stops)
    return (yield from identified_and_verified(robot, readings, memory, wanted_mm, advised=advised))


GUIDED = {"reference": reference, "two_mounts": two_mounts}
"""Plans that need a person once."""
CALIBRATE = register(RunKind("calibrate", calibrate, offsets=True))
