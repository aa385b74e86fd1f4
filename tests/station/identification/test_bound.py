"""The bound on the largest position error: right in closed form, kept by machines, and judged."""

from __future__ import annotations

import numpy as np
import pytest

from station.fitting import largest_error_bound
from station.identification import PLAN_ENDED, accuracy_of, bounds_mm, identify, with_accuracy
from station.plans import make_plan
from station.records import AccuracyReached, JointAngle
from station.studies.drawn import drawn, robot_of
from tests.station.fakes import result_of

RAYLEIGH_95 = np.sqrt(-2.0 * np.log(0.05))
"""95 % of two-dimensional normal errors of standard deviation 1 are shorter."""


def test_one_place_is_rayleigh() -> None:
    jacobian = np.eye(2)[None]
    bound = largest_error_bound(np.zeros((1, 2)), jacobian, np.eye(2) * 0.04)
    assert bound == pytest.approx(0.2 * RAYLEIGH_95, rel=0.02)


def test_it_is_what_very_many_draws_show() -> None:
    rng = np.random.default_rng(5)
    mean, jacobian = rng.normal(size=(6, 2)), rng.normal(size=(6, 2, 4))
    root = rng.normal(size=(4, 4))
    drawn = mean[:, :, None] + jacobian @ root @ rng.normal(size=(4, 200_000))
    brute = np.quantile(np.sqrt((drawn**2).sum(axis=1)).max(axis=0), 0.95)
    assert largest_error_bound(mean, jacobian, root @ root.T) == pytest.approx(brute, rel=0.012)


def test_a_known_error_is_all_of_it() -> None:
    mean = np.array([[3.0, 4.0], [0.0, 1.0]])
    assert largest_error_bound(mean, np.zeros((2, 2, 3)), np.eye(3)) == pytest.approx(5.0)


def test_what_moves_nothing_may_be_unknown() -> None:
    covariance = np.diag([0.04, 0.04, np.inf])
    jacobian = np.array([[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    bound = largest_error_bound(np.zeros((1, 2)), jacobian, covariance)
    assert bound == pytest.approx(0.2 * RAYLEIGH_95, rel=0.02)


def test_machines_keep_it() -> None:
    """By the emulated machine's physics; 40 machines, six readings and one angle each."""
    robot, kept = robot_of(0.03), []
    stops = make_plan("rapid", robot).stops
    for seed in range(40):
        machine, rng = drawn(robot, seed)
        seen_deg = float(np.degrees(machine.truth[0]) + rng.normal(0.0, 0.005))
        informed = robot.informed([JointAngle(joint=1, at_deg=0.0, reads_deg=seen_deg, sd_deg=0.005)])
        fit = identify(informed, machine.machine().measure(stops))
        kept.append(np.array(machine.largest_errors_mm(fit)) <= bounds_mm(fit))
    share = np.mean(kept, axis=0)
    assert (share >= 0.875).all()
    assert np.mean(kept) < 1.0


def test_zeros_that_are_not_as_identified_are_counted() -> None:
    robot = robot_of(0.003)
    machine, _ = drawn(robot, 3)
    fit = identify(robot, machine.machine().measure(make_plan("full", robot).stops))
    off = fit.dtheta + np.radians([0.2, 0.2])
    assert accuracy_of(fit, None, zeros=off).bound_95_mm > 2.0 + bounds_mm(fit)[0]  # type: ignore[operator]


@pytest.mark.parametrize(
    ("bound_mm", "wanted_mm", "reached", "outcome"),
    [
        (0.2, None, None, "good"),
        (0.2, 0.2, True, "good"),
        (0.201, 0.2, False, "not_accurate_enough"),
        (float("nan"), 0.2, False, "not_accurate_enough"),
        (None, 0.2, False, "not_accurate_enough"),
        (None, None, None, "good"),
    ],
)
def test_the_wish_decides(
    bound_mm: float | None, wanted_mm: float | None, reached: bool | None, outcome: str
) -> None:
    accuracy = AccuracyReached.of(bound_mm, 0.1, wanted_mm, PLAN_ENDED)
    result = with_accuracy(result_of([]), accuracy)
    assert (accuracy.reached, result.outcome) == (reached, outcome)
    assert (result.verdict == "pass") == (outcome == "good")
    if bound_mm == 0.201:
        assert "0.201 mm; 0.2 mm are wanted" in result.reason.text


def test_what_further_readings_could_reach_is_not_stated_as_reached() -> None:
    accuracy = AccuracyReached.of(1.585, 1.585, 0.8, PLAN_ENDED)
    reason = with_accuracy(result_of([]), accuracy, possible_mm=1.068).reason
    assert (reason.code, reason.params) == (
        "accuracy_out_of_reach",
        {"possible_mm": 1.068, "wanted_mm": 0.8},
    )
    reached = with_accuracy(result_of([]), accuracy, possible_mm=1.585).reason
    assert (reached.code, reached.params["possible_mm"]) == ("not_accurate_enough", 1.585)


def test_a_failure_keeps_its_own_reason() -> None:
    failed = result_of([], "fail")
    result = with_accuracy(failed, AccuracyReached.of(0.3, 0.1, 0.2, PLAN_ENDED))
    assert (result.outcome, result.reason) == (failed.outcome, failed.reason)
