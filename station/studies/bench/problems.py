"""The two identifications that are timed, as whitened residuals with and without derivatives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from station.fitting import Prior, Residuals, Solution, solve, tolerance_prior
from station.five_bar import SCALE_SD_MM, FiveBar, Geometry, Robot, forward, perturbed
from station.records import Measurements, Real
from station.studies.bench.four_unknowns import observe_four_unknowns
from station.studies.reproduce import true_errors
from station.studies.simulation import SimulatedMachine

READINGS = 60


@dataclass(frozen=True)
class Problem:
    """Minimise |residuals|^2 + |W (x - m)|^2 from `start`."""

    residuals: Residuals
    """With the Jacobian in closed form."""
    model: Callable[[Real], Real]
    """x -> whitened residuals (R,) from the forward position alone, as peers without derivatives see it."""
    distances: Callable[[Real], tuple[Real, Geometry, float]]
    """x -> actual joint angles (K, 2), geometry and reading offset; for the scalar forward model."""
    measured: Real
    sd: Real
    start: Real
    prior: Prior

    def solve(self) -> Solution:
        return solve(self.residuals, self.start, self.prior)

    def stacked(self, x: Real) -> Real:
        """(R + H,) residuals with the prior's rows below."""
        return np.concatenate([self.model(x), self.prior.root @ (x - self.prior.mean)])

    def stacked_jacobian(self, x: Real) -> Real:
        return np.concatenate([self.residuals(x)[1], self.prior.root])


def _measured(robot: Robot) -> Measurements:
    """60 places of the workspace, group 1 of the paper, one reading each."""
    rng = np.random.default_rng(0)
    places = rng.uniform(*robot.workspace_x, READINGS) + 1j * rng.uniform(*robot.workspace_y, READINGS)
    machine = SimulatedMachine(robot, true_errors(1), "whole pulses", seed=0)
    return machine.read_at(robot, places)


def four_by_60() -> Problem:
    """The paper's four unknowns and the reading offset, nothing known beforehand."""
    robot = Robot.default()
    data, nominal = _measured(robot), robot.geometry
    theta, distance, sd = data.theta, data.distance, np.full(READINGS, SCALE_SD_MM)

    def residuals(x: Real) -> tuple[Real, Real]:
        at = observe_four_unknowns(nominal, x, theta)
        return (at.value - distance) / SCALE_SD_MM, at.by_parameter / SCALE_SD_MM

    def distances(x: Real) -> tuple[Real, Geometry, float]:
        geometry = Geometry(nominal.e, nominal.L, nominal.l, nominal.cd + complex(x[2], x[3]))
        return theta + x[:2], geometry, float(x[4])

    prior = Prior(np.zeros(5), np.zeros((0, 5)))
    return Problem(residuals, _model(distances, distance, sd), distances, distance, sd, np.zeros(5), prior)


def thirteen_by_60() -> Problem:
    """All twelve errors and the reading offset, with the tolerances as prior."""
    robot = Robot.default()
    data = _measured(robot)
    mechanism = FiveBar(robot, data)
    nominal, theta, distance, sd = robot.geometry, data.theta, data.distance, mechanism.row_sd

    def residuals(x: Real) -> tuple[Real, Real]:
        at = mechanism.observe(x, theta)
        return (at.value - distance) / sd, at.by_parameter / sd[:, None]

    def distances(x: Real) -> tuple[Real, Geometry, float]:
        return theta + x[:2], perturbed(nominal, x[:12]), float(x[12])

    prior = tolerance_prior(mechanism)
    return Problem(residuals, _model(distances, distance, sd), distances, distance, sd, prior.mean, prior)


def _model(
    distances: Callable[[Real], tuple[Real, Geometry, float]], measured: Real, sd: Real
) -> Callable[[Real], Real]:
    def model(x: Real) -> Real:
        theta, geometry, rho0 = distances(x)
        return np.asarray((np.abs(forward(geometry, theta) - geometry.cd) - rho0 - measured) / sd)

    return model
