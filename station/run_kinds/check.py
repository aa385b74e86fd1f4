"""Plan `check`: has the robot changed since its last calibration?

Four readings are compared with the prediction of that calibration, including its uncertainty and the noise.
The offset of the readout is free: the readout may have been switched off since.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import numpy as np

from station.errors import NotApplicable, NotFound
from station.five_bar import FiveBar
from station.identification import Identification
from station.motion import shift_of
from station.plans import REST_P, SHIFT_P, ShiftTest, make_plan
from station.records import (
    LIMIT_SDS,
    CalibrationRequest,
    CalibrationResult,
    CalibrationSummary,
    CheckFound,
    MeasurementSequence,
    Outcome,
    Procedure,
    Reading,
    because,
    from_readings,
    residual_rows,
)
from station.run_kinds.apply import source_of
from station.run_kinds.fits import wandered
from station.run_kinds.kind import RunKind, Start, has_offsets, register
from station.run_kinds.zero_state import application
from station.store import Store

MOST_LOOKED_AT = 500


def compared_with(store: Store, serial: str) -> CalibrationSummary | None:
    """The last applied run of a robot, otherwise its last pass; None without either."""
    passes = store.calibrations(limit=MOST_LOOKED_AT, robot_serial=serial, verdict="pass").items
    for run in passes:
        if run.kind == "apply" and run.of is not None:
            applied = store.summary(run.of)
            known = application(store, applied)
            if known is not None and known.state == "applied":
                return applied
    return next((run for run in passes if has_offsets(run)), None)


def check_check(store: Store, request: CalibrationRequest) -> None:
    """:raises NotApplicable: there is no calibration to compare with."""
    if compared_with(store, request.robot_serial) is None:
        raise NotApplicable(
            f"Robot {request.robot_serial} has no passed calibration to be checked against; calibrate first."
        )


def start_check(start: Start) -> Procedure:
    """The procedure, not yet started.  :raises NotFound: no calibration to compare with."""
    run = compared_with(start.store, start.robot.serial)
    if run is None:
        raise NotFound(f"Robot {start.robot.serial} has no passed calibration.")
    source = source_of(start.store, run.id)
    shift_deg = shift_of(start.store.zero_writes(start.robot.serial, since=run.id))
    now = start.began_at or datetime.now(UTC)
    age_days = (now - (run.ended_at or run.created_at)).total_seconds() / 86_400.0
    until = now + timedelta(hours=start.limits.check_valid_h)
    return check_run(source.fit.moved(shift_deg), max(age_days, 0.0), until)


def check_run(fit: Identification[FiveBar], age_days: float, until: datetime) -> Procedure:
    """Four readings, and whether they agree with the prediction."""
    robot = fit.mechanism.robot
    stops = make_plan("check", robot, fit.dtheta).stops
    readings: list[Reading] = yield MeasurementSequence("Checking", 1, stops, last=True)
    mechanism = FiveBar(robot, from_readings(readings, fit.measurements.mounts))
    at = mechanism.observe(fit.p, mechanism.theta)
    sd = mechanism.row_sd * fit.lasting.noise_ratio * fit.sd_factor
    rows = at.by_parameter / sd[:, None]
    known = wandered(fit, age_days)
    covariance = rows @ known @ rows.T + np.eye(len(rows))
    test = ShiftTest(rows[:, :2], covariance, fit.noise.dof)
    difference = mechanism.measured - at.value
    difference = difference - difference.mean()
    # in the displayed values the unlimited offset of the readout is removed with the mean
    beside = at.by_parameter - at.by_parameter.mean(axis=0)
    difference_sd = np.sqrt(np.sum(beside @ known * beside, axis=1) + sd**2)
    shift, shift_p, rest_p = test.shift(difference / sd)
    smallest_deg, shift_deg = np.degrees(test.smallest()), np.degrees(shift)
    direction, blind = test.blind()
    together = "both arms together" if direction[0] * direction[1] > 0 else "one arm against the other"
    smallest_shift_deg = float(smallest_deg.max())
    outcome: Outcome
    if shift_p >= SHIFT_P and rest_p >= REST_P:
        outcome, reason = "good", because("still_calibrated", smallest_deg=smallest_shift_deg)
    elif shift_p < SHIFT_P:
        shifts = {"shift1_deg": float(shift_deg[0]), "shift2_deg": float(shift_deg[1])}
        outcome, reason = "repair", because("zero_shifted", **shifts, smallest_deg=smallest_shift_deg)
    else:
        outcome, reason = "unexplained", because("not_as_calibrated", p=rest_p)
    return CalibrationResult(
        verdict="pass" if outcome == "good" else "fail",
        outcome=outcome,
        reason=reason,
        method="check",
        zero_offsets=(),
        check=CheckFound(
            smallest_shift_deg=smallest_shift_deg,
            smallest_by_joint_deg=(float(smallest_deg[0]), float(smallest_deg[1])),
            shift_deg=(float(shift_deg[0]), float(shift_deg[1])),
            p_value=min(shift_p, rest_p),
            blind=together,
            blind_shift_deg=float(np.degrees(blind)),
            valid_until=until if outcome == "good" else None,
        ),
        residuals=residual_rows(readings, difference, LIMIT_SDS * difference_sd),
    )


CHECK = register(RunKind("check", start_check, check=check_check))
