"""Confirmation by fresh readings: its p-values are true for models that the readings leave wide open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from station.diagnosis.tests_of_fit.confirmation import REFUSED_P, confirm
from station.fitting.prior import tolerance_prior
from station.five_bar.mechanism import FiveBar
from station.mechanism.conditions import reference_of
from station.model.model import Model, fit
from station.records import Real
from tests.station.groups import group, measure

DRAWS = 500


def p_values(off_mm: Real | float = 0.0) -> list[float]:
    """Of fresh readings beyond the learned ones, from machines that the posterior allows."""
    from station.five_bar.robot_file import Robot

    robot = replace(Robot.default(), feedback_sd_deg=0.0)
    rng = np.random.default_rng(3)
    # learned on one half of the workspace: on the other the model is far less certain than a reading
    learned_at = robot.workspace_grid(9, 5)
    learned_at = learned_at[learned_at.real < -80.0]
    readings = measure(robot, group(1), np.concatenate([learned_at] * 2), rng)
    mechanism = FiveBar(robot, readings)
    base = fit(Model(mechanism, reference_of(readings)), tolerance_prior(mechanism), mechanism.row_sd)
    root = np.linalg.cholesky(base.solution.covariance)
    places = robot.workspace_grid(5, 4)
    asked = measure(robot, group(1), places[places.real > 80.0], rng)
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
