"""Verification decides whether offsets may be used: p-values are true, power is known, it fails closed.

Null hypothesis of each p-value: the machine is one that the posterior of the fit allows.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy import stats

from station.five_bar.kinematics import forward, inverse
from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.identification.estimate import Identification, identify
from station.identification.verification import (
    Verification,
    fresh_stops,
    not_identified,
    predicted_result,
    prediction_fault,
    residuals_of,
    result_of,
    verify,
)
from station.model.model import Fit
from station.records import Complex, JointAngle, Measurements, Reading, Real, from_readings
from tests.station.simulated import group, measure

ROBOT = replace(Robot.default(), feedback_sd_deg=0.0)
GRID = ROBOT.workspace_grid(5, 3)
PLACES = ROBOT.workspace_grid(4, 2)
DRAWS = 400


@cache
def fitted() -> Identification[FiveBar]:
    return identify(ROBOT, measure(ROBOT, group(1), GRID, 0, repeats=3))


def fresh_readings(
    fit: Identification[FiveBar], rng: np.random.Generator, off_mm: Real | float = 0.0
) -> Measurements:
    """Of a machine that the posterior allows, `off_mm` (K,) added to what it reads."""
    root = np.linalg.cholesky(fit.covariance)
    machine = fit.p + root @ rng.standard_normal(len(fit.p))
    asked = _at(PLACES)
    mechanism = FiveBar(ROBOT, asked)
    noise = fit.noise.sigma_mm * rng.standard_normal(len(asked))
    return replace(asked, distance=mechanism.observe(machine, asked.theta).value + noise + off_mm)


def _at(places: Complex) -> Measurements:
    count = len(places)
    return Measurements(
        ids=tuple(range(1, count + 1)),
        t_s=np.arange(count, dtype=float),
        theta=inverse(ROBOT.geometry, places),
        approach=np.zeros((count, 2), dtype=np.int8),
        distance=np.zeros(count),
        position=np.arange(count),
        mount=np.zeros(count, dtype=np.intp),
        samples=np.ones(count, dtype=np.intp),
    )


@pytest.mark.parametrize("offset_known", [True, False])
def test_p_values_of_true_models_are_uniform(offset_known: bool) -> None:
    rng = np.random.default_rng(5)
    p = [
        verify(fitted(), fresh_readings(fitted(), rng), offset_known=offset_known).p_value
        for _ in range(DRAWS)
    ]
    assert stats.kstest(p, "uniform").pvalue > 0.01
    assert np.mean(np.array(p) < 0.1) == pytest.approx(0.1, abs=0.05)


def test_half_of_the_machines_at_the_limit_are_refused() -> None:
    """Eight readings moved alike in size and in turn: noncentral chi-square says how often."""
    fit, rng = fitted(), np.random.default_rng(6)
    critical = stats.chi2.isf(1e-3, len(PLACES))
    pattern = np.where(np.arange(len(PLACES)) % 2 == 0, 1.0, -1.0)
    mechanism = FiveBar(ROBOT, _at(PLACES))
    J = mechanism.observe(fit.p, mechanism.theta).by_parameter
    covariance = J @ fit.covariance @ J.T + fit.noise.sigma_mm**2 * np.eye(len(PLACES))
    per_mm = float(pattern @ np.linalg.solve(covariance, pattern))
    size = np.sqrt(critical / per_mm)
    expected = float(stats.ncx2.sf(critical, len(PLACES), size**2 * per_mm))
    refused = [not verify(fit, fresh_readings(fit, rng, size * pattern)).passed for _ in range(DRAWS)]
    assert 0.3 < expected < 0.9
    assert np.mean(refused) == pytest.approx(expected, abs=0.08)


def test_a_p_value_that_is_no_number_never_passes() -> None:
    doubtful = Verification(np.zeros(8), np.ones(8), float("nan"))
    assert not doubtful.passed
    fault = prediction_fault(doubtful)
    assert fault is not None and fault.code == "not_finite"


def test_a_result_without_finite_uncertainty_fails() -> None:
    fit = fitted()
    covariance = fit.solution.covariance.copy()
    covariance[0, 0] = np.nan
    broken = replace(fit, fit=replace(fit.fit, solution=replace(fit.solution, covariance=covariance)))
    readings = [
        Reading(k + 1, float(k), (0.0, 180.0), (0, 0), 1.0, f"P{k}") for k in range(len(fit.measurements))
    ]
    result = result_of(broken, readings[:3], readings[3:11])
    assert (result.verdict, result.outcome, result.reason.code) == ("fail", "failed", "not_finite")


# What a result states ----------------------------------------------------------------------------


def as_readings(measured: Measurements, first: int, sequence: int) -> list[Reading]:
    theta = np.degrees(measured.theta)
    return [
        Reading(
            first + k,
            float(k),
            (float(theta[k, 0]), float(theta[k, 1])),
            (0, 0),
            float(measured.distance[k]),
            f"P{measured.position[k]}",
            sequence,
        )
        for k in range(len(measured))
    ]


def both(off_mm: float = 0.0) -> tuple[list[Reading], list[Reading]]:
    """The readings of the fit, and fresh ones of which the fifth is off."""
    off = np.where(np.arange(len(PLACES)) == 4, off_mm, 0.0)
    fresh = fresh_readings(fitted(), np.random.default_rng(9), off)
    return as_readings(fitted().measurements, 1, 1), as_readings(fresh, 101, 2)


def test_a_result_states_the_fit_its_residuals_and_what_fresh_readings_say() -> None:
    fit = fitted()
    readings, fresh = both()
    check = verify(fit, from_readings(fresh))
    result = result_of(fit, readings, fresh)
    assert (result.verdict, result.outcome) == ("pass", "good")
    assert (result.method, result.lack_of_fit) == ("measurement model", None)
    assert result.reason.code == "fresh_readings_agree"
    rms_um = 1e3 * float(np.sqrt(np.mean(check.residual_mm**2)))
    assert result.reason.params == {"rms_um": pytest.approx(rms_um)}
    assert (*result.zero_offsets, *result.parameters) == fit.quantities()
    assert [q.name for q in result.zero_offsets] == ["dtheta1", "dtheta2"]
    assert result.weak_direction == fit.weak_direction
    before, after = result.before, result.after
    assert before is not None and after is not None
    nominal = inverse_error(readings)
    assert before.reading_rms_mm == pytest.approx(float(np.std(nominal)), rel=1e-9)
    assert before.predicted_position_error_mm == fit.position_error(compensated=False)
    assert before.fresh_reading_rms_mm is None
    assert after.reading_rms_mm == pytest.approx(float(np.sqrt(np.mean(fit.residual_mm**2))))
    assert after.fresh_reading_rms_mm == pytest.approx(rms_um / 1e3)
    assert after.fresh_reading_max_mm == pytest.approx(float(np.abs(check.residual_mm).max()))
    assert after.predicted_position_error_mm == fit.position_error(compensated=True)
    assert [row.reading for row in result.residuals] == [r.reading for r in readings]
    assert [row.residual_mm for row in result.residuals] == pytest.approx(fit.residual_mm.tolist())
    assert {row.limit_mm for row in result.residuals} == {3.5 * fit.noise.sigma_mm}


def inverse_error(readings: list[Reading]) -> Real:
    """(K,) mm, what the nominal machine would read at these joints less what was read, but for a constant."""
    measured = from_readings(readings)
    g = ROBOT.geometry
    # the printed mechanism error is part of what is nominal
    error: Real = measured.distance - np.abs(forward(g, measured.theta) - g.cd - complex(*ROBOT.drm))
    return error


def test_fresh_readings_that_disagree_fail_and_name_the_worst() -> None:
    readings, fresh = both(off_mm=0.3)
    check = verify(fitted(), from_readings(fresh))
    result = result_of(fitted(), readings, fresh)
    assert (result.verdict, result.outcome, result.reason.code) == (
        "fail",
        "unexplained",
        "fresh_readings_disagree",
    )
    assert (result.lack_of_fit, result.lack_of_fit_reason) == (result.reason.text, result.reason)
    assert result.reason.params == {
        "p": check.p_value,
        "number": 5,
        "residual_um": pytest.approx(1e3 * check.residual_mm[4]),
        "sd_um": pytest.approx(1e3 * check.sd_mm[4]),
    }
    assert check.residual_mm[4] > 0.2


def test_a_model_that_does_not_fit_its_own_readings_fails_whatever_the_fresh_ones_say() -> None:
    readings, fresh = both()
    poor = replace(fitted(), lack_of_fit_p=1e-4)
    result = result_of(poor, readings, fresh)
    assert (result.verdict, result.outcome, result.reason.code) == ("fail", "unexplained", "lack_of_fit")
    assert result.reason.params == {"p": 1e-4}
    assert (result.lack_of_fit, result.lack_of_fit_reason) == (result.reason.text, result.reason)


def wrong_reference() -> JointAngle:
    """The angle of joint 1, read half a degree off."""
    reads = -3.0 + float(np.degrees(group(1)[0])) + 0.5
    return JointAngle(joint=1, at_deg=-3.0, reads_deg=reads, sd_deg=0.005)


def test_a_reference_that_the_readings_contradict_fails_and_is_named() -> None:
    readings, fresh = both()
    reference = wrong_reference()
    fit = identify(ROBOT.informed((reference,)), fitted().measurements)
    (use,) = fit.references
    assert use.residual == pytest.approx(0.5, abs=0.2)
    for result in (result_of(fit, readings, fresh), predicted_result(fit, readings)):
        assert (result.verdict, result.outcome, result.reason.code) == (
            "fail",
            "unexplained",
            "reference_contradicted",
        )
        assert result.reason.params == {
            "reference": reference.words,
            "difference": use.residual,
            "sd": use.sd,
            "unit": "deg",
        }
        assert (result.lack_of_fit, result.lack_of_fit_reason) == (result.reason.text, result.reason)
        assert result.references == fit.references


def test_readings_that_were_predicted_before_they_were_used_pass_or_fail_by_their_own_p_value() -> None:
    readings, _ = both()
    good = predicted_result(fitted(), readings)
    assert (good.verdict, good.outcome, good.reason.code) == ("pass", "good", "readings_as_predicted")
    assert good.reason.params == {"readings": len(readings)}
    assert [row.reading for row in good.residuals] == [r.reading for r in readings]
    poor = predicted_result(replace(fitted(), lack_of_fit_p=1e-4), readings)
    assert (poor.verdict, poor.outcome, poor.reason.code) == ("fail", "unexplained", "predictions_disagree")
    assert poor.reason.params == {"p": 1e-4}


def test_residuals_are_also_those_of_readings_that_took_no_part() -> None:
    readings, fresh = both(off_mm=0.3)
    rows = residuals_of(fitted(), [*readings, *fresh])
    assert [row.reading for row in rows] == [r.reading for r in (*readings, *fresh)]
    assert [row.residual_mm for row in rows[: len(readings)]] == pytest.approx(fitted().residual_mm.tolist())
    expected = from_readings(fresh)
    observed = FiveBar(ROBOT, expected).observe(fitted().p, expected.theta).value
    off = [row.residual_mm for row in rows[len(readings) :]]
    assert off == pytest.approx((expected.distance - observed).tolist())
    assert (expected.distance - observed)[4] > 0.2


def test_parameters_that_are_no_numbers_fail() -> None:
    readings, fresh = both()
    x = fitted().p.copy()
    x[[p.name for p in fitted().mechanism.parameters].index("rho0")] = np.nan
    solution = replace(fitted().solution, x=x)
    broken = replace(fitted(), fit=Fit(fitted().fit.model, solution, fitted().fit.prior, fitted().fit.row_sd))
    result = result_of(broken, readings, fresh)
    assert (result.verdict, result.outcome, result.reason.code) == ("fail", "failed", "not_finite")


def test_readings_that_no_machine_gives_are_a_failure_with_the_refusal_as_reason() -> None:
    result = not_identified("Impossible result: L1 is off.")
    assert (result.verdict, result.outcome, result.method) == ("fail", "failed", "measurement model")
    assert (result.reason.code, result.reason.text) == ("not_identified", "Impossible result: L1 is off.")
    assert result.lack_of_fit == "Impossible result: L1 is off."
    assert result.zero_offsets == ()


def test_the_p_value_is_chi_square_with_the_prediction_covariance() -> None:
    """Recomputed with plain inverses; without the offset, of the differences to the first reading."""
    fit = replace(fitted(), sd_factor=1.5)
    fresh = fresh_readings(fit, np.random.default_rng(1))
    at = FiveBar(ROBOT, fresh).observe(fit.p, fresh.theta)
    residual = fresh.distance - at.value
    covariance = at.by_parameter @ fit.covariance @ at.by_parameter.T
    covariance += (1.5 * fit.noise.sigma_mm) ** 2 * np.eye(len(fresh))
    check = verify(fit, fresh)
    assert check.p_value == pytest.approx(
        stats.chi2.sf(residual @ np.linalg.inv(covariance) @ residual, len(fresh)), rel=1e-6
    )
    assert check.residual_mm == pytest.approx(residual)
    assert check.sd_mm == pytest.approx(np.sqrt(np.diag(covariance)))
    D = np.concatenate([-np.ones((len(fresh) - 1, 1)), np.eye(len(fresh) - 1)], axis=1)
    differences = D @ residual
    square = differences @ np.linalg.inv(D @ covariance @ D.T) @ differences
    loose = verify(fit, fresh, offset_known=False)
    assert loose.p_value == pytest.approx(stats.chi2.sf(square, len(fresh) - 1), rel=1e-6)
    assert loose.residual_mm == pytest.approx(residual - residual.mean())
    shifted = replace(fresh, distance=fresh.distance + 100.0)
    assert verify(fit, shifted, offset_known=False).p_value == pytest.approx(loose.p_value, rel=1e-4)


@pytest.mark.parametrize(("p_value", "passed"), [(0.00101, True), (0.001, True), (0.00099, False)])
def test_one_true_model_in_a_thousand_is_refused(p_value: float, passed: bool) -> None:
    # the worst is the one farthest off for its uncertainty, not the largest
    check = Verification(np.array([0.5, -0.4]), np.array([1.0, 0.1]), p_value)
    assert check.passed is passed
    fault = prediction_fault(check)
    assert (fault is None) is passed
    if fault is not None:
        assert fault.params == {"p": p_value, "number": 2, "residual_um": -400.0, "sd_um": 100.0}
    assert check.rms_mm == pytest.approx(np.sqrt((0.25 + 0.16) / 2))


def test_fresh_stops_stand_within_the_workspace_and_are_compensated() -> None:
    fit = fitted()
    stops = fresh_stops(fit)
    assert [stop.position for stop in stops] == [f"V{k}" for k in range(1, 9)]
    (x0, x1), (y0, y1) = ROBOT.workspace_x, ROBOT.workspace_y
    x, y = np.array([stop.target_mm for stop in fresh_stops(fit, 64)]).T
    assert (x.min() >= x0 + 15.0) and (x.max() <= x1 - 15.0)
    assert (y.min() >= y0 + 15.0) and (y.max() <= y1 - 15.0)
    # spread over all of it, not a part
    assert x.max() - x.min() > 0.9 * (x1 - x0 - 30.0) and y.max() - y.min() > 0.9 * (y1 - y0 - 30.0)
    commanded = np.radians([stop.theta_deg for stop in stops]) + fit.dtheta
    reached = forward(ROBOT.geometry, commanded)
    assert np.array([[r.real, r.imag] for r in reached]) == pytest.approx(
        np.array([stop.target_mm for stop in stops])
    )
    assert all(stop.approach == (0, 0) for stop in stops)


def test_fresh_stops_are_others_for_another_run_and_the_same_by_seed() -> None:
    fit = fitted()
    assert fresh_stops(fit) == fresh_stops(fit, seed=len(fit.measurements))
    first, second = (fresh_stops(fit, 4, seed, "C") for seed in (1, 2))
    assert [stop.position for stop in first] == ["C1", "C2", "C3", "C4"]
    assert first == fresh_stops(fit, 4, 1, "C")
    assert not {s.target_mm for s in first} & {s.target_mm for s in second}
