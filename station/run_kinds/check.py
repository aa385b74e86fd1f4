"""Plan `check`: has the robot changed since its last calibration?

Four readings are compared with the prediction of that calibration, including its uncertainty and the noise.
The offset of the readout is free: the readout may have been switched off since.
"""

from __future__ import annotations

from dataclasses import dataclass
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
    Real,
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
    return _newest_pass(store, serial)


def check_check(store: Store, request: CalibrationRequest) -> None:
    """:raises NotApplicable: there is no calibration to compare with."""
    if compared_with(store, request.robot_serial) is None:
        raise NotApplicable(
            f"Robot {request.robot_serial} has no passed calibration to be checked against; calibrate first."
        )


@dataclass(frozen=True)
class Calibrated:
    """A calibration that a check compares with, in the present frame of the drives."""

    run: int
    fit: Identification[FiveBar]
    age_days: float


def start_check(start: Start) -> Procedure:
    """The procedure, not yet started.  :raises NotFound: no calibration to compare with."""
    run = compared_with(start.store, start.robot.serial)
    if run is None:
        raise NotFound(f"Robot {start.robot.serial} has no passed calibration.")
    newest = _newest_pass(start.store, start.robot.serial)
    now = start.began_at or datetime.now(UTC)
    unwritten = None if newest is None or newest.id <= run.id else _calibrated(start.store, newest, now)
    until = now + timedelta(hours=start.limits.check_valid_h)
    reference = _calibrated(start.store, run, now)
    return check_run(reference.fit, reference.age_days, until, unwritten)


def _newest_pass(store: Store, serial: str) -> CalibrationSummary | None:
    passes = store.calibrations(limit=MOST_LOOKED_AT, robot_serial=serial, verdict="pass").items
    return next((run for run in passes if has_offsets(run)), None)


def _calibrated(store: Store, run: CalibrationSummary, now: datetime) -> Calibrated:
    shift_deg = shift_of(store.zero_writes(run.robot_serial, since=run.id))
    age_days = (now - (run.ended_at or run.created_at)).total_seconds() / 86_400.0
    return Calibrated(run.id, source_of(store, run.id).fit.moved(shift_deg), max(age_days, 0.0))


class Comparison:
    """Four readings against the prediction of a calibration."""

    def __init__(self, fit: Identification[FiveBar], age_days: float, readings: list[Reading]) -> None:
        mechanism = FiveBar(fit.mechanism.robot, from_readings(readings, fit.measurements.mounts))
        at = mechanism.observe(fit.p, mechanism.theta)
        self._sd = mechanism.row_sd * fit.lasting.noise_ratio * fit.sd_factor
        self._by_parameter = at.by_parameter
        self._known = wandered(fit, age_days)
        rows = at.by_parameter / self._sd[:, None]
        covariance = rows @ self._known @ rows.T + np.eye(len(rows))
        self.test = ShiftTest(rows[:, :2], covariance, fit.noise.dof)
        difference = mechanism.measured - at.value
        self.difference = difference - difference.mean()
        self.shift, self.shift_p, self.rest_p = self.test.shift(self.difference / self._sd)

    @property
    def agrees(self) -> bool:
        return self.shift_p >= SHIFT_P and self.rest_p >= REST_P

    @property
    def difference_sd(self) -> Real:
        """(4,) mm; the unlimited offset of the readout is removed with the mean, as in the differences."""
        beside = self._by_parameter - self._by_parameter.mean(axis=0)
        return np.asarray(np.sqrt(np.sum(beside @ self._known * beside, axis=1) + self._sd**2))


def check_run(
    fit: Identification[FiveBar], age_days: float, until: datetime, unwritten: Calibrated | None = None
) -> Procedure:
    """Four readings, and whether they agree with the prediction.

    :param unwritten: a newer calibration whose zeros are not in the drives
    """
    stops = make_plan("check", fit.mechanism.robot, fit.dtheta).stops
    readings: list[Reading] = yield MeasurementSequence("Checking", 1, stops, last=True)
    found = Comparison(fit, age_days, readings)
    smallest_deg, shift_deg = np.degrees(found.test.smallest()), np.degrees(found.shift)
    direction, blind = found.test.blind()
    together = "both arms together" if direction[0] * direction[1] > 0 else "one arm against the other"
    smallest_shift_deg = float(smallest_deg.max())
    shifts = {"shift1_deg": float(shift_deg[0]), "shift2_deg": float(shift_deg[1])}
    known_by = None
    outcome: Outcome
    if found.agrees:
        outcome, reason = "good", because("still_calibrated", smallest_deg=smallest_shift_deg)
    elif unwritten and Comparison(unwritten.fit, unwritten.age_days, readings).agrees:
        known_by = unwritten.run
        outcome, reason = "repair", because("shift_known", **shifts, number=known_by)
    elif found.shift_p < SHIFT_P:
        outcome, reason = "repair", because("zero_shifted", **shifts, smallest_deg=smallest_shift_deg)
    else:
        outcome, reason = "unexplained", because("not_as_calibrated", p=found.rest_p)
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
            p_value=min(found.shift_p, found.rest_p),
            blind=together,
            blind_shift_deg=float(np.degrees(blind)),
            valid_until=until if outcome == "good" else None,
            known_by=known_by,
        ),
        residuals=residual_rows(readings, found.difference, LIMIT_SDS * found.difference_sd),
    )


CHECK = register(RunKind("check", start_check, check=check_check))
