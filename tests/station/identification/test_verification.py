"""Verification decides whether offsets may be used: p-values are true, power is known, it fails closed.

Null hypothesis of each p-value: the machine is one that the posterior of the fit allows.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy import stats

from station.five_bar.kinematics import inverse
from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.identification.estimate import Identification, identify
from station.identification.verification import Verification, prediction_fault, result_of, verify
from station.records import Complex, Measurements, Reading, Real
from tests.station.groups import group, measure

ROBOT = replace(Robot.default(), feedback_sd_deg=0.0)
GRID = ROBOT.workspace_grid(5, 3)
PLACES = ROBOT.workspace_grid(4, 2)
DRAWS = 400


@cache
def fitted() -> Identification[FiveBar]:
    return identify(ROBOT, measure(ROBOT, group(1), GRID, np.random.default_rng(0), repeats=3))


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
