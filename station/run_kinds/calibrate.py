"""A calibration: measure by a plan, identify, verify by readings that took no part in the fit."""

from __future__ import annotations

import numpy as np
from scipy.special import chdtrc

from station.errors import InputRefused
from station.five_bar import FiveBar, Robot
from station.identification import (
    Identification,
    Memory,
    Verification,
    fresh_stops,
    fresh_stops_of,
    gate_record,
    identify,
    not_identified,
    prediction_fault,
    result_of,
    without_jump,
)
from station.plans import make_plan
from station.published import MAX_PASSES, PublishedRun
from station.records import (
    CalibrationResult,
    MeasurementSequence,
    MemoryUse,
    PlanName,
    Procedure,
    Reading,
    Remembered,
    because,
    from_readings,
)
from station.run_kinds.kind import RunKind, Start, register

DAYS_PER_YEAR = 365.25


def calibrate(start: Start) -> Procedure:
    """The procedure of a plan, not yet started.

    :raises InputRefused: the plan cannot be made for this robot.
    """
    if start.plan == "paper":  # the published method has no use for what earlier runs know
        return published(start.robot)
    return measured_and_verified(
        start.plan, start.robot, start.store.memory(start.robot.serial, start.began_at)
    )


def published(robot: Robot) -> Procedure:
    """Section 4 and 5: measure, identify, compensate, again until mu < mu_0 (eq. 32, 33); then verify."""
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
    fresh: list[Reading] = yield MeasurementSequence("Verifying at fresh positions", number + 1, stops)
    return without_jump(_verified(run, result, fresh), robot, [*everything, *fresh])


def _verified(run: PublishedRun, result: CalibrationResult, fresh: list[Reading]) -> CalibrationResult:
    """A pass, if fresh readings are as the result predicts them."""
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
        }
    )


def measured_and_verified(plan: PlanName, robot: Robot, memory: Remembered | None = None) -> Procedure:
    """The measurement model on a chosen plan, then fresh positions that took no part in the fit."""
    readings: list[Reading] = yield MeasurementSequence("Measuring", 1, make_plan(plan, robot).stops)
    age_days = memory.age_days if memory else 0.0
    try:
        fit = fit_of(robot, readings, memory, age_days)
    except InputRefused as refusal:
        return without_jump(not_identified(str(refusal)), robot, readings)
    fresh: list[Reading] = yield MeasurementSequence("Verifying at fresh positions", 2, fresh_stops(fit))
    result = result_of(fit, readings, fresh).model_copy(update={"lasting": fit.lasting.record()})
    result = without_jump(result, robot, [*readings, *fresh])
    if memory is None or fit.gate is None:
        return result
    use = MemoryUse(**dict(gate_record(fit.gate)), from_calibration=memory.calibration_id, age_days=age_days)
    return result.model_copy(update={"memory": use})


def fit_of(
    robot: Robot, readings: list[Reading], memory: Remembered | None, age_days: float
) -> Identification[FiveBar]:
    """The measurement model on readings, with what is remembered as it was at that age.

    :raises InputRefused: as `identify`.
    """
    measurements = from_readings(readings)
    if memory is None:
        return identify(robot, measurements)
    parameters = FiveBar(robot, measurements).parameters
    return identify(
        robot,
        measurements,
        Memory.of(memory.memory).aged(parameters, age_days / DAYS_PER_YEAR),
    )


CALIBRATE = register(RunKind("calibrate", calibrate, offsets=True))
