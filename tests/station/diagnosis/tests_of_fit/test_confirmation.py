"""Confirmation by fresh readings: its p-values are true for models that the readings leave wide open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from station.diagnosis.tests_of_fit.confirmation import confirm
from station.fitting import REFUSED_P
from station.fitting.prior import tolerance_prior
from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.mechanism.conditions import reference_of
from station.model.model import Model, fit
from station.records import Real
from tests.station.simulated import group, measure

DRAWS = 500


def p_values(off_mm: Real | float = 0.0) -> list[float]:
    """Of fresh readings beyond the learned ones, from machines that the posterior allows."""
    robot = replace(Robot.default(), feedback_sd_deg=0.0)
    rng = np.random.default_rng(3)
    # learned on one half of the workspace: on the other the model is far less certain than a reading
    learned_at = robot.workspace_grid(9, 5)
    learned_at = learned_at[learned_at.real < -80.0]
    readings = measure(robot, group(1), np.concatenate([learned_at] * 2), 1)
    mechanism = FiveBar(robot, readings)
    base = fit(Model(mechanism, reference_of(readings)), tolerance_prior(mechanism), mechanism.row_sd)
    root = np.linalg.cholesky(base.solution.covariance)
    places = robot.workspace_grid(5, 4)
    asked = measure(robot, group(1), places[places.real > 80.0], 2)
    fresh = FiveBar(robot, asked)
    out = []
    for _ in range(DRAWS):
        machine = base.x + root @ rng.standard_normal(len(base.x))
        value = fresh.observe(machine, asked.theta).value + base.row_sd.mean() * rng.standard_normal(
            len(asked)
        )
        out.append(confirm(base, base, replace(asked, distance=value + off_mm), 10_000).p_value)
    return out


def test_p_values_of_true_models_are_uniform() -> None:
    assert stats.kstest(p_values(), "uniform").pvalue > 0.01


def test_readings_that_no_machine_gives_are_refused() -> None:
    wrong = 0.02 * np.where(np.arange(8) % 2 == 0, 1.0, -1.0)
    assert np.mean(np.array(p_values(wrong)) < REFUSED_P) > 0.95


def test_the_limit_is_one_in_a_thousand() -> None:
    assert pytest.approx(1e-3) == REFUSED_P


@pytest.mark.parametrize("many", [False, True])
def test_the_p_value_is_of_f_with_as_many_degrees_of_freedom_as_fresh_readings(
    many: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Recomputed with plain inverses: F(K, noise dof) of the chi-square over K, short and long logs alike."""
    monkeypatch.setattr("station.diagnosis.tests_of_fit.confirmation.is_long", lambda mechanism: many)
    robot = replace(Robot.default(), feedback_sd_deg=0.0)
    readings = measure(robot, group(1), robot.workspace_grid(5, 3), 1, repeats=2)
    mechanism = FiveBar(robot, readings)
    base = fit(Model(mechanism, reference_of(readings)), tolerance_prior(mechanism), mechanism.row_sd)
    off = 2.5e-3 * np.array([1.0, -1.0, 1.0, -1.0, 1.0])
    asked = measure(robot, group(1), robot.workspace_grid(5, 1) + 20.0j, 2)
    fresh = replace(asked, distance=asked.distance + off)
    at = FiveBar(robot, fresh).observe(base.x, fresh.theta)
    residual = fresh.distance - at.value
    covariance = at.by_parameter @ base.solution.covariance @ at.by_parameter.T
    covariance += np.diag(FiveBar(robot, fresh).row_sd ** 2)
    square = float(residual @ np.linalg.inv(covariance) @ residual)
    for noise_dof in (4, 30):
        found = confirm(base, base, fresh, noise_dof)
        assert found.left_out == ()
        assert found.p_value == pytest.approx(stats.f.sf(square / 5, 5, noise_dof), rel=1e-5)
        assert found.sd_mm == pytest.approx(np.sqrt(np.diag(covariance)), rel=1e-6)
    assert 1e-4 < found.p_value < 0.9
    assert confirm(base, base, fresh, 0).p_value == pytest.approx(stats.f.sf(square / 5, 5, 1), rel=1e-5)
