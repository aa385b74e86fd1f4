"""Rank-one updates against inverted matrices, the test of the memory against draws, quickest sets."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from scipy.stats import chi2

from station.plans import Contradiction, Pace, Quickest, changes_of, gains, with_readings

RNG = np.random.default_rng(1)
ROWS = RNG.standard_normal((20, 6))
ROOT = RNG.standard_normal((6, 6))
COVARIANCE = np.linalg.inv(ROOT @ ROOT.T + np.eye(6))
WEIGHT = np.diag([3.0, 2.0, 1.0, 0.0, 0.0, 0.5])


def after(rows: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.inv(np.linalg.inv(COVARIANCE) + rows.T @ rows))


def test_a_gain_is_what_one_more_reading_does() -> None:
    before = np.trace(COVARIANCE @ WEIGHT)
    expected = [before - np.trace(after(ROWS[[k]]) @ WEIGHT) for k in range(20)]
    np.testing.assert_allclose(gains(COVARIANCE, ROWS, WEIGHT), expected, rtol=1e-9)


def test_several_readings_at_once() -> None:
    np.testing.assert_allclose(with_readings(COVARIANCE, ROWS[:9]), after(ROWS[:9]), rtol=1e-9)


TEST = Contradiction(
    remembered=np.diag([0.04, 0.09]),
    lasting=np.array([4, 5]),
    passing=np.array([0, 1, 2, 3]),
    known=np.array([1.0, 1.0, 0.0, 0.0]),
    p_value=0.02,
)


def test_the_power_against_a_changed_memory_is_what_draws_show() -> None:
    """Readings of a changed machine, unknowns fitted anew, the memory tested: how often is it refused?"""
    rows, change = ROWS[:8], np.array([0.8, -0.5])
    information = rows.T @ rows
    power = TEST.power(TEST.noncentrality(information, change[None]), np.array(2))[0]
    held = rows[:, :4]
    nuisance = np.linalg.inv(np.eye(8) + held @ np.diag([1.0, 1.0, 1e8, 1e8]) @ held.T)
    told = rows[:, 4:]
    spread = told.T @ nuisance @ told
    refused = 0
    draws = 2000
    for _ in range(draws):
        unknowns = np.concatenate([RNG.standard_normal(2), RNG.standard_normal(2) * 1e3])
        off = RNG.standard_normal(2) * [0.2, 0.3] + change
        reading = held @ unknowns + told @ off + RNG.standard_normal(8)
        score = told.T @ nuisance @ reading
        square = score @ np.linalg.solve(spread + spread @ TEST.remembered @ spread, score)
        refused += square > chi2.isf(0.02, 2)
    assert refused / draws == pytest.approx(power, abs=0.03)


def test_no_direction_no_power() -> None:
    assert TEST.directions(ROWS[:2].T @ ROWS[:2]) == 0
    assert TEST.power(np.array([1e6]), np.array(0)) == [0.0]


def test_what_may_have_changed() -> None:
    names = ("e1x", "L1", "L2", "l1", "l2", "rMx", "rMy")
    changes = changes_of(names, 1.0, 0.3)
    np.testing.assert_allclose(np.linalg.norm(changes[:-4], axis=1), 1.0)
    np.testing.assert_allclose(changes[-4:, 1:5], 0.3 * np.eye(4))


def quickest(enough: float) -> Quickest:
    return Quickest(
        covariance=COVARIANCE,
        rows=ROWS[:12],
        weight=WEIGHT,
        stays=0.0,
        enough=enough,
        theta_deg=RNG.uniform(-30.0, 30.0, (12, 2)),
        here_deg=np.zeros(2),
        pace=Pace(30.0, 0.5, 0.2),
        test=None,
        changes=np.zeros((0, 0)),
        power=0.98,
    )


def test_a_set_is_accurate_enough_and_as_small_as_that_allows() -> None:
    enough = float(np.sort([np.trace(after(ROWS[list(c)]) @ WEIGHT) for c in combinations(range(12), 3)])[10])
    chosen = quickest(enough).choose(2, 5)
    assert len(chosen) == 3
    assert np.trace(after(ROWS[chosen]) @ WEIGHT) <= enough


def test_where_nothing_is_enough_it_is_the_best_of_the_most() -> None:
    assert len(quickest(1e-9).choose(2, 4)) == 4
