"""Verification at fresh places, and the result of a calibration by the measurement model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import stats
from scipy.linalg import null_space
from scipy.stats import qmc

from station.five_bar import FiveBar, inverse
from station.identification.five_bar import Identification
from station.identification.weak_direction import describe_weak_direction
from station.records import CalibrationResult, Measurements, Reading, Real, Stop, from_readings

FRESH_PLACES = 8
FRESH_INSET_MM = 15.0
REFUSED_P = 1e-3
"""A true model fails the verification this often."""
LIMIT_SDS = 3.5


def fresh_stops(
    fit: Identification, count: int = FRESH_PLACES, seed: int | None = None, label: str = "V"
) -> tuple[Stop, ...]:
    """Interior places that no plan visits, commands compensated by what was identified.

    :param count: a power of two
    """
    robot = fit.mechanism.robot
    low = (robot.workspace_x[0] + FRESH_INSET_MM, robot.workspace_y[0] + FRESH_INSET_MM)
    high = (robot.workspace_x[1] - FRESH_INSET_MM, robot.workspace_y[1] - FRESH_INSET_MM)
    # a new set each run, so that no place is ever learned by heart
    sequence = qmc.Sobol(2, rng=len(fit.measurements) if seed is None else seed)
    points = qmc.scale(sequence.random(count), low, high)
    places = points[:, 0] + 1j * points[:, 1]
    theta = np.degrees(inverse(robot.geometry, places) - fit.dtheta)
    return tuple(
        Stop(f"{label}{k + 1}", (float(r.real), float(r.imag)), (float(t[0]), float(t[1])))
        for k, (r, t) in enumerate(zip(places, theta, strict=True))
    )


@dataclass(frozen=True)
class Verification:
    """Fresh readings against the frozen model."""

    residual_mm: Real
    """(K,) measured less predicted."""
    sd_mm: Real
    """(K,) prediction uncertainty with noise."""
    p_value: float

    @property
    def passed(self) -> bool:
        return bool(self.p_value >= REFUSED_P)

    @property
    def rms_mm(self) -> float:
        return float(np.sqrt(np.mean(self.residual_mm**2)))


def verify(fit: Identification, fresh: Measurements, *, offset_known: bool = True) -> Verification:
    """Predict fresh readings with everything frozen; chi-square with the prediction covariance.

    :param offset_known: False when the readout may have been switched off or zeroed since the fit
    """
    mechanism = FiveBar(fit.mechanism.robot, fresh)
    at = mechanism.observe(fit.p, fresh.theta)
    residual = fresh.distance - at.value
    ratio = fit.noise.sigma_mm / float(np.sqrt(np.mean(fit.mechanism.row_sd**2)))
    noise = np.diag((mechanism.row_sd * ratio * fit.sd_factor) ** 2)
    covariance = at.by_parameter @ fit.covariance @ at.by_parameter.T + noise
    told = np.eye(len(residual)) if offset_known else null_space(np.ones((1, len(residual))))
    rest, its_covariance = told.T @ residual, told.T @ covariance @ told
    square = float(rest @ np.linalg.solve(its_covariance, rest))
    sd = np.sqrt(np.diag(told @ its_covariance @ told.T))
    return Verification(told @ rest, sd, float(stats.chi2.sf(square, len(rest))))


def result_of(fit: Identification, readings: list[Reading], fresh: list[Reading]) -> CalibrationResult:
    """Zero offsets with uncertainty, before and after, and a verdict that fails closed."""
    check = verify(fit, from_readings(fresh))
    quantities = fit.quantities()
    everything = from_readings(readings)
    mechanism = FiveBar(fit.mechanism.robot, everything)
    start = np.array([p.prior_mean for p in mechanism.parameters])
    raw = everything.distance - mechanism.observe(start, everything.theta).value
    residual = everything.distance - mechanism.observe(fit.p, everything.theta).value
    limit = LIMIT_SDS * fit.noise.sigma_mm
    misfit = _misfit(fit, check)
    reason = _not_finite(fit) or misfit
    return CalibrationResult(
        verdict="fail" if reason else "pass",
        reason=reason or f"fresh readings agree within {check.rms_mm * 1e3:.1f} um",
        method="measurement model",
        zero_offsets=quantities[:2],
        parameters=quantities[2:],
        weak_direction=weak_direction_of(fit),
        before={
            "reading_rms_mm": float(np.std(raw)),
            "predicted_position_error_mm": fit.position_error(compensated=False),
        },
        after={
            "reading_rms_mm": float(np.sqrt(np.mean(fit.residual_mm**2))),
            "fresh_reading_rms_mm": check.rms_mm,
            "fresh_reading_max_mm": float(np.abs(check.residual_mm).max()),
            "predicted_position_error_mm": fit.position_error(compensated=True),
        },
        iterations=(),
        residuals=tuple(
            {
                "reading": r.reading,
                "position": r.position,
                "residual_mm": float(value),
                "limit_mm": limit,
            }
            for r, value in zip(readings, residual, strict=True)
        ),
        lack_of_fit=misfit,
    )


def not_identified(refusal: str) -> CalibrationResult:
    """Of readings that no machine within the tolerances gives.

    The station took them itself: the model lacks something, or the robot file is of another machine.
    """
    return CalibrationResult(
        verdict="fail",
        reason=refusal,
        method="measurement model",
        zero_offsets=(),
        parameters=(),
        weak_direction={},
        before={},
        after={},
        iterations=(),
        residuals=(),
        lack_of_fit=refusal,
    )


def prediction_fault(check: Verification) -> str:
    """Why fresh readings do not confirm the model; empty when they do, on finite numbers."""
    if not np.isfinite(check.p_value):
        return "the result is not a finite number"
    if check.passed:
        return ""
    worst = int(np.argmax(np.abs(check.residual_mm) / check.sd_mm))
    return (
        f"fresh readings are not predicted (p = {check.p_value:.1g}); the worst, number {worst + 1}, "
        f"is off by {check.residual_mm[worst] * 1e3:.1f} um, sd {check.sd_mm[worst] * 1e3:.1f} um"
    )


def weak_direction_of(fit: Identification) -> dict[str, Any]:
    """The least known direction in words, and what would help most."""
    return with_best_remedy(describe_weak_direction(fit))


def with_best_remedy(words: dict[str, Any]) -> dict[str, Any]:
    """The description of a weak direction with `remedy`, what would help most."""
    best = min(words["remedies"], key=lambda remedy: remedy["sd_deg"])
    return {**words, "remedy": f"{best['text']} (sd {best['sd_deg']:.3f} deg)"}


def _not_finite(fit: Identification) -> str:
    """Why nothing can be said of the run; empty when all numbers are finite."""
    sd = np.sqrt(np.diag(fit.covariance)[:2])
    if not (np.isfinite(sd).all() and np.isfinite(fit.p).all()):
        return "the result is not a finite number"
    return ""


def _misfit(fit: Identification, check: Verification) -> str:
    """What the model does not account for, in the readings or in the fresh ones; empty when it fits."""
    if not fit.adequate:
        return (
            f"the model does not fit the readings (p = {fit.lack_of_fit_p:.1g}); "
            "an effect is missing from it: run the diagnosis"
        )
    return prediction_fault(check)
