"""Verification at fresh positions, and the result of a calibration by the measurement model."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import null_space
from scipy.special import chdtrc

from station.fitting import REFUSED_P
from station.five_bar import FRESH_INSET_MM, FiveBar, Robot, inverse
from station.identification.estimate import Identification
from station.identification.references import contradicted
from station.records import (
    LIMIT_SDS,
    Accuracy,
    CalibrationResult,
    Measurements,
    Reading,
    Real,
    Reason,
    ReferenceUse,
    Residual,
    Stop,
    because,
    from_readings,
    residual_rows,
)

FRESH_PLACES = 8


def fresh_stops(
    fit: Identification[FiveBar], count: int = FRESH_PLACES, seed: int | None = None, label: str = "V"
) -> tuple[Stop, ...]:
    """Interior positions that no plan visits; the commands are compensated by the identified offsets.

    :param count: a power of two
    """
    seed = len(fit.measurements) if seed is None else seed
    return fresh_stops_of(fit.mechanism.robot, fit.dtheta, seed, count, label)


def fresh_stops_of(
    robot: Robot, dtheta: Real, seed: int, count: int = FRESH_PLACES, label: str = "V"
) -> tuple[Stop, ...]:
    """The same for zero offsets (2,) rad, however they were identified."""
    low = np.array([robot.workspace_x[0], robot.workspace_y[0]]) + FRESH_INSET_MM
    high = np.array([robot.workspace_x[1], robot.workspace_y[1]]) - FRESH_INSET_MM
    # a new set each run, so that no position can be learned by repetition
    points = low + _spread(seed, count) * (high - low)
    places = points[:, 0] + 1j * points[:, 1]
    theta = np.degrees(inverse(robot.geometry, places) - dtheta)
    return tuple(
        Stop(f"{label}{k + 1}", (float(r.real), float(r.imag)), (float(t[0]), float(t[1])))
        for k, (r, t) in enumerate(zip(places, theta, strict=True))
    )


@lru_cache(maxsize=64)
def _spread(seed: int, count: int) -> Real:
    """(count, 2) points spread evenly over the unit square; cached, since studies repeat the request."""
    from scipy.stats import qmc  # imported here because it takes a second to load and only a run needs it

    return np.asarray(qmc.Sobol(2, rng=seed).random(count))


@dataclass(frozen=True)
class Verification:
    """Fresh readings compared with the fixed model."""

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


def verify(fit: Identification[FiveBar], fresh: Measurements, *, offset_known: bool = True) -> Verification:
    """Predict fresh readings with all parameters fixed; chi-square with the prediction covariance.

    :param offset_known: False when the readout may have been switched off or zeroed since the fit
    """
    mechanism = FiveBar(fit.mechanism.robot, fresh)
    at = mechanism.observe(fit.p, fresh.theta)
    residual = fresh.distance - at.value
    ratio = fit.noise.sigma_mm / float(np.sqrt(np.mean(fit.mechanism.row_sd**2)))
    noise = np.diag((mechanism.row_sd * ratio * fit.sd_factor) ** 2)
    covariance = at.by_parameter @ fit.covariance @ at.by_parameter.T + noise
    observable = np.eye(len(residual)) if offset_known else null_space(np.ones((1, len(residual))))
    seen, seen_covariance = observable.T @ residual, observable.T @ covariance @ observable
    square = float(seen @ np.linalg.solve(seen_covariance, seen))
    sd = np.sqrt(np.diag(observable @ seen_covariance @ observable.T))
    return Verification(observable @ seen, sd, float(chdtrc(len(seen), square)))


def result_of(
    fit: Identification[FiveBar], readings: list[Reading], fresh: list[Reading]
) -> CalibrationResult:
    """Zero offsets with uncertainty, before and after, and a verdict that is a fail in case of doubt."""
    check = verify(fit, from_readings(fresh, fit.measurements.mounts))
    result = _result(
        fit, readings, _misfit(fit, check), because("fresh_readings_agree", rms_um=check.rms_mm * 1e3)
    )
    assert result.after is not None
    fresh_mm = {
        "fresh_reading_rms_mm": check.rms_mm,
        "fresh_reading_max_mm": float(np.abs(check.residual_mm).max()),
    }
    return result.model_copy(update={"after": result.after.model_copy(update=fresh_mm)})


def predicted_result(fit: Identification[FiveBar], readings: list[Reading]) -> CalibrationResult:
    """The same where each reading was predicted before it was used, which `fit.lack_of_fit_p` judges."""
    misfit = None
    if worst := contradicted(fit.references):
        misfit = reference_contradicted(worst)
    elif not fit.adequate:
        misfit = because("predictions_disagree", p=fit.lack_of_fit_p)
    return _result(fit, readings, misfit, because("readings_as_predicted", readings=len(readings)))


def _result(
    fit: Identification[FiveBar], readings: list[Reading], misfit: Reason | None, agreed: Reason
) -> CalibrationResult:
    quantities = fit.quantities()
    everything = from_readings(readings)
    mechanism = FiveBar(fit.mechanism.robot, everything)
    raw = everything.distance - mechanism.observe(mechanism.start, everything.theta).value
    not_finite = _not_finite(fit)
    fault = not_finite or misfit
    return CalibrationResult(
        verdict="fail" if fault else "pass",
        outcome="failed" if not_finite else "unexplained" if misfit else "good",
        reason=fault or agreed,
        method="measurement model",
        zero_offsets=quantities[:2],
        parameters=quantities[2:],
        weak_direction=fit.weak_direction,
        before=Accuracy(
            reading_rms_mm=float(np.std(raw)),
            predicted_position_error_mm=fit.position_error(compensated=False),
        ),
        after=Accuracy(
            reading_rms_mm=float(np.sqrt(np.mean(fit.residual_mm**2))),
            predicted_position_error_mm=fit.position_error(compensated=True),
        ),
        residuals=_residuals(fit, readings, mechanism),
        references=fit.references,
        lack_of_fit=misfit.text if misfit else None,
        lack_of_fit_reason=misfit,
    )


def residuals_of(fit: Identification[FiveBar], readings: list[Reading]) -> tuple[Residual, ...]:
    """Residual of each reading with its limit, including excluded readings."""
    return _residuals(fit, readings, FiveBar(fit.mechanism.robot, from_readings(readings)))


def _residuals(
    fit: Identification[FiveBar], readings: list[Reading], everything: FiveBar
) -> tuple[Residual, ...]:
    residual = everything.measured - everything.observe(fit.p, everything.theta).value
    return residual_rows(readings, residual, np.full(len(readings), LIMIT_SDS * fit.noise.sigma_mm))


def not_identified(refusal: str) -> CalibrationResult:
    """The result for readings that no machine within the tolerances can give.

    The station took them itself: the model lacks an effect, or the robot file is of another machine.
    """
    reason = because("not_identified", text=refusal)
    return CalibrationResult(
        verdict="fail",
        outcome="failed",
        reason=reason,
        method="measurement model",
        zero_offsets=(),
        lack_of_fit=refusal,
        lack_of_fit_reason=reason,
    )


def prediction_fault(check: Verification) -> Reason | None:
    """Why fresh readings do not confirm the model; None when they do, on finite numbers."""
    if not np.isfinite(check.p_value):
        return because("not_finite")
    if check.passed:
        return None
    worst = int(np.argmax(np.abs(check.residual_mm) / check.sd_mm))
    return because(
        "fresh_readings_disagree",
        p=check.p_value,
        number=worst + 1,
        residual_um=float(check.residual_mm[worst]) * 1e3,
        sd_um=float(check.sd_mm[worst]) * 1e3,
    )


def reference_contradicted(use: ReferenceUse) -> Reason:
    """Why a result that depends on this reference is not credible."""
    return because(
        "reference_contradicted",
        reference=use.reference.words,
        difference=use.residual or 0.0,
        sd=use.sd or 0.0,
        unit=use.unit,
    )


def _not_finite(fit: Identification[FiveBar]) -> Reason | None:
    """Why the run cannot be evaluated; None when all numbers are finite."""
    sd = np.sqrt(np.diag(fit.covariance)[:2])
    if not (np.isfinite(sd).all() and np.isfinite(fit.p).all()):
        return because("not_finite")
    return None


def _misfit(fit: Identification[FiveBar], check: Verification) -> Reason | None:
    """The misfit of the model in the readings or in the fresh ones; None when it fits."""
    if worst := contradicted(fit.references):
        return reference_contradicted(worst)
    if not fit.adequate:
        return because("lack_of_fit", p=fit.lack_of_fit_p)
    return prediction_fault(check)
