"""The solver: a case by hand, a degenerate one, a real one against a general solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from station.fitting.least_squares import NotConvergedError, Prior, Solution, solve
from station.fitting.prior import tolerance_prior
from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.records import Real
from tests.station.fitting.nist import NistProblem, problems
from tests.station.simulated import group, measure

ROBOT = Robot.default()
NOTHING_KNOWN = np.inf


def test_a_line_through_three_points_by_hand() -> None:
    """y = a + b x through (0, 1), (1, 2), (2, 3) with sd 1: a = b = 1, variances 5/6 and 1/2."""
    A = np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 2.0]])
    y = np.array([1.0, 2.0, 3.0])
    prior = Prior.independent(np.zeros(2), np.full(2, NOTHING_KNOWN))
    found = solve(lambda x: (A @ x - y, A), np.zeros(2), prior)
    assert found.x == pytest.approx([1.0, 1.0])
    assert np.diag(found.covariance) == pytest.approx([5 / 6, 1 / 2])
    assert found.cost == pytest.approx(0.0, abs=1e-20)


def test_a_prior_weighs_as_one_more_reading() -> None:
    prior = Prior.independent(np.array([4.0]), np.array([1.0]))
    found = solve(lambda x: (x - 2.0, np.eye(1)), np.zeros(1), prior)
    assert found.x == pytest.approx([3.0])
    assert found.covariance[0, 0] == pytest.approx(0.5)


def test_a_blind_direction_has_no_finite_uncertainty() -> None:
    """x1 + x2 is all that is measured: neither may be printed with an sd."""
    A = np.array([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0], [0.0, 0.0, 1.0]])
    prior = Prior.independent(np.zeros(3), np.full(3, NOTHING_KNOWN))
    found = solve(lambda x: (A @ x - 1.0, A), np.zeros(3), prior)
    assert found.blind == 1
    assert np.isinf(np.diag(found.covariance)).tolist() == [True, True, False]


def test_a_model_that_is_not_a_number_is_refused() -> None:
    prior = Prior.independent(np.zeros(1), np.ones(1))
    with pytest.raises(NotConvergedError, match="cannot be evaluated"):
        solve(lambda x: (x * np.nan, np.eye(1)), np.zeros(1), prior)


def test_step_control_survives_a_start_far_away() -> None:
    """arctan: the undamped step overshoots for ever from |x| > 1.39."""
    prior = Prior.independent(np.zeros(1), np.full(1, NOTHING_KNOWN))
    found = solve(lambda x: (np.arctan(x), np.diag(1 / (1 + x**2))), np.array([20.0]), prior)
    assert found.x == pytest.approx([0.0], abs=1e-9)


@pytest.mark.parametrize("unknowns", ["four", "all"])
@pytest.mark.parametrize("number", [1, 2, 3])
def test_agrees_with_a_general_solver(unknowns: str, number: int) -> None:
    rng = np.random.default_rng(number)
    places = rng.uniform(-240, 240, 60) + 1j * rng.uniform(-782, -632, 60)
    measurements = measure(ROBOT, group(number), places, number)
    mechanism = FiveBar(ROBOT, measurements)
    start = np.array([p.prior_mean for p in mechanism.parameters])
    free = np.array([0, 1, 10, 11, 12]) if unknowns == "four" else np.arange(13)

    def residuals(x: Real) -> tuple[Real, Real]:
        p = start.copy()
        p[free] = x
        at = mechanism.observe(p, mechanism.theta)
        sd = mechanism.row_sd
        return (at.value - measurements.distance) / sd, at.by_parameter[:, free] / sd[:, None]

    prior = tolerance_prior(mechanism)
    if unknowns == "four":
        prior = Prior.independent(np.zeros(5), np.full(5, NOTHING_KNOWN))
    ours: Solution = solve(residuals, start[free], prior)

    def stacked(x: Real) -> Real:
        return np.concatenate([residuals(x)[0], prior.root @ (x - prior.mean)])

    def stacked_jacobian(x: Real) -> Real:
        return np.concatenate([residuals(x)[1], prior.root])

    # the general solver stops where its cost no longer changes in double precision, a little short
    # along the weak direction; of its ways there the one with the least gradient left is compared
    def left(x: Real) -> float:
        gradient = stacked_jacobian(x).T @ stacked(x)
        return float(gradient @ ours.covariance @ gradient)

    tight = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15}
    answers = []
    for _ in range(12):
        x = start[free] + rng.normal(0.0, 1e-3, len(free))
        for way in ({"method": "dogbox", "x_scale": "jac"}, {"method": "lm"}):
            x = least_squares(stacked, x, stacked_jacobian, **way, **tight).x  # type: ignore[arg-type]
            answers.append(x)
    x = min(answers, key=left)
    sd = np.sqrt(np.diag(ours.covariance))
    assert np.linalg.norm(ours.x - x) <= 1e-9 * np.linalg.norm(x)
    assert (np.abs(ours.x - x) <= 1e-9 * np.abs(x) + 1e-6 * sd).all()


NIST = problems()
DOUBLE_PRECISION = 1e-9
"""Of the largest y.  Lanczos1 is known to 14 digits: its residuals are the rounding of its y."""


def whitened(problem: NistProblem) -> NistProblem:
    least = DOUBLE_PRECISION * float(np.abs(problem.y).max())
    return replace(problem, residual_sd=max(problem.residual_sd, least))


@pytest.mark.parametrize("start", [1, 2])
@pytest.mark.parametrize("name", NIST)
def test_certified_problems_to_six_digits(name: str, start: int) -> None:
    """NIST StRD, all levels of difficulty, from the far and the near start: values and uncertainties."""
    problem = whitened(NIST[name])
    begin = problem.starts[start - 1]
    found = solve(problem.residuals, begin, Prior(begin, np.zeros((0, len(begin)))))
    assert found.complete, found.message
    assert found.x == pytest.approx(problem.certified, rel=1e-6)
    scale = problem.residual_sd / NIST[name].residual_sd
    assert np.sqrt(np.diag(found.covariance)) == pytest.approx(problem.sd * scale, rel=1e-5)


def test_a_fit_that_is_stopped_early_says_so_and_widens_its_uncertainty() -> None:
    problem = NIST["MGH10"]
    begin = problem.starts[0]
    prior = Prior(begin, np.zeros((0, len(begin))))
    early, done = solve(problem.residuals, begin, prior, 12), solve(problem.residuals, begin, prior)
    assert (early.status, early.complete, early.steps) == ("stopped", False, 12)
    assert early.gain_left > 1.0
    assert "stopped before the minimum" in early.message
    assert done.complete
    off = np.abs(early.x - done.x)
    assert (off < 3.0 * np.sqrt(np.diag(early.covariance))).all()
