"""What others solve the same problems with."""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
from scipy.optimize import least_squares

from station.five_bar import Geometry
from station.records import Real
from station.studies.bench.problems import Problem

Peer = Callable[[Problem], Callable[[], Real]]
"""A problem -> the call that solves it."""
STEPS = 50
CONVERGED = 1e-5
"""Largest step, mm or rad; central differences do not let it come below 2e-6."""


def numpy_gauss_newton(problem: Problem) -> Callable[[], Real]:
    """Gauss-Newton with central differences."""
    return lambda: _gauss_newton(problem.stacked, problem.start)


def scalar_python(problem: Problem) -> Callable[[], Real]:
    """The same with a forward model written for one pose in plain Python."""

    def stacked(x: Real) -> Real:
        theta, geometry, rho0 = problem.distances(x)
        rho = np.array([_distance(geometry, float(a), float(b)) for a, b in theta])
        data = (rho - rho0 - problem.measured) / problem.sd
        return np.concatenate([data, problem.prior.root @ (x - problem.prior.mean)])

    return lambda: _gauss_newton(stacked, problem.start)


def scipy_lm(problem: Problem) -> Callable[[], Real]:
    return lambda: np.asarray(least_squares(problem.stacked, problem.start, method="lm").x)


def scipy_trf(problem: Problem) -> Callable[[], Real]:
    return lambda: np.asarray(least_squares(problem.stacked, problem.start, method="trf", x_scale="jac").x)


def lmfit_leastsq(problem: Problem) -> Callable[[], Real]:
    from lmfit import Minimizer, Parameters

    parameters = Parameters()
    for i, value in enumerate(problem.start):
        parameters.add(f"x{i}", value=float(value))

    def residuals(named: Parameters) -> Real:
        return problem.stacked(np.array(list(named.valuesdict().values())))

    def fit() -> Real:
        found = Minimizer(residuals, parameters, calc_covar=False).leastsq()
        return np.array(list(found.params.valuesdict().values()))

    return fit


def installed() -> dict[str, Peer]:
    """By name."""
    peers: dict[str, Peer] = {
        "numpy Gauss-Newton, central differences": numpy_gauss_newton,
        "scipy least_squares lm": scipy_lm,
        "scipy least_squares trf": scipy_trf,
        "Gauss-Newton, scalar Python forward model": scalar_python,
    }
    if find_spec("lmfit"):
        peers["lmfit leastsq"] = lmfit_leastsq
    return peers


def _gauss_newton(stacked: Callable[[Real], Real], start: Real) -> Real:
    x = start.copy()
    for _ in range(STEPS):
        residual = stacked(x)
        jacobian = np.empty((len(residual), len(x)))
        for i in range(len(x)):
            h = np.zeros(len(x))
            h[i] = 1e-6
            jacobian[:, i] = (stacked(x + h) - stacked(x - h)) / 2e-6
        step = np.linalg.lstsq(jacobian, -residual)[0]
        x = x + step
        if np.abs(step).max() < CONVERGED:
            break
    return x


def _distance(geometry: Geometry, theta1: float, theta2: float) -> float:
    """|O_1 O_2| of one pose."""
    elbows = []
    for i, theta in enumerate((theta1, theta2)):
        e, L = geometry.e[i], geometry.L[i]
        elbows.append((e.real + L * math.cos(theta), e.imag + L * math.sin(theta)))
    (x1, y1), (x2, y2) = elbows
    dx, dy = x1 - x2, y1 - y2
    square = dx * dx + dy * dy
    l1, l2 = geometry.l
    along = 0.5 + 0.5 * (l2 * l2 - l1 * l1) / square
    across = math.sqrt(l2 * l2 / square - along * along)
    x, y = x2 + dx * along + dy * across, y2 + dy * along - dx * across
    cd = complex(geometry.cd)
    return math.hypot(x - cd.real, y - cd.imag)
