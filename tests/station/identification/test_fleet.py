"""What robots of one type teach: their spread, as far as their readings show it, and no more."""

from __future__ import annotations

import numpy as np
import pytest

from station.identification import Memory, fleet_prior, identify
from station.plans import make_plan
from station.records import FleetPrior, LastingParameters
from station.studies.drawn import Drawn, drawn, robot_of

ROBOT = robot_of(0.3)
NAMES = ("e1x", "e1y", "e2x", "e2y", "L1", "L2", "l1", "l2")


def left(mean: np.ndarray, sd: float | np.ndarray, fleet: FleetPrior | None = None) -> LastingParameters:
    covariance = np.diag(np.full(8, sd) ** 2)
    return LastingParameters(
        names=NAMES, mean=tuple(mean), covariance=tuple(tuple(row) for row in covariance), fleet=fleet
    )


def told(robots: list[LastingParameters]) -> FleetPrior:
    prior = fleet_prior("T", ROBOT, [(ROBOT, one) for one in robots])
    assert prior is not None
    return prior


def test_nobody_teaches_nothing() -> None:
    assert fleet_prior("T", ROBOT, []) is None


def test_many_robots_that_are_well_known_show_mean_and_spread() -> None:
    rng = np.random.default_rng(1)
    shared = np.linspace(-0.4, 0.4, 8)
    robots = [left(shared + 0.05 * rng.standard_normal(8), 0.001) for _ in range(40)]
    prior = told(robots)
    np.testing.assert_allclose(prior.mean, shared, atol=0.05)
    sd = np.sqrt(np.diag(prior.covariance))
    assert (sd > 0.045).all()
    assert (sd < 0.12).all()


def test_what_readings_do_not_show_stays_at_the_tolerance() -> None:
    unseen = [left(np.zeros(8), np.array([0.001] * 4 + [0.3] * 4)) for _ in range(10)]
    sd = np.sqrt(np.diag(told(unseen).covariance))
    assert (sd[:4] < 0.15).all()
    np.testing.assert_allclose(sd[4:], 0.3, rtol=0.2)


def test_what_a_robot_started_from_is_not_counted_again() -> None:
    """A robot whose readings said nothing leaves what it was given, and teaches nothing."""
    first = told([left(np.full(8, 0.2), 0.01)])
    given = LastingParameters(names=NAMES, mean=first.mean, covariance=first.covariance, fleet=first)
    again = told([left(np.full(8, 0.2), 0.01), given])
    np.testing.assert_allclose(again.mean, first.mean, atol=0.02)
    np.testing.assert_allclose(np.diag(again.covariance), np.diag(first.covariance), rtol=0.2)


@pytest.mark.parametrize(("off_mm", "used"), [(0.0, True), (1.5, False)])
def test_a_robot_that_is_not_like_the_others_drops_them(off_mm: float, used: bool) -> None:
    stops = make_plan("full", ROBOT).stops
    machine, _ = drawn(ROBOT, 4)
    prior = told([left(machine.truth[2:10], 0.01) for _ in range(10)])
    truth = machine.truth.copy()
    truth[6] += off_mm
    found = identify(ROBOT, Drawn(ROBOT, truth, 4).machine().run(stops, 5), Memory.of_fleet(prior))
    assert found.gate is not None
    assert found.gate.used is used
    assert found.lasting.fleet == (prior if used else None)
