"""A promise and the machine that it was made of, beside what the linear model allows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.fitting import tolerance_prior
from station.five_bar import SIZE, FiveBar
from station.identification import Identification, bounds_mm
from station.plans import zeros_only
from station.records import Real
from station.studies.drawn import GRID, Drawn, largest_errors_mm
from station.studies.population import PlainMachine

DRAWS = 16
"""Of the linear model, a machine: their median scatters a quarter of what the figure beside it does."""


@dataclass(frozen=True)
class Kept:
    """mm"""

    largest_mm: float
    """Largest true position error over the workspace, zeros in the drives only."""
    bound_mm: float
    by_model_mm: float
    """The same with commands of the identified model."""
    bound_by_model_mm: float
    allowed_mm: tuple[float, ...] = ()
    """The largest errors that an estimator at the Cramer-Rao bound would leave."""


def kept(machine: Drawn, fit: Identification[FiveBar], rng: np.random.Generator | None = None) -> Kept:
    """What a fit promises and leaves.

    :param rng: for draws of the linear model; None: none are made
    """
    stand = PlainMachine(machine.robot, machine.truth).stand
    largest, by_model = largest_errors_mm(machine.robot, fit, stand)
    bound, bound_by_model = bounds_mm(fit)
    allowed = () if rng is None else _allowed(machine, fit.mechanism, rng)
    return Kept(largest, bound, by_model, bound_by_model, allowed)


def _allowed(machine: Drawn, mechanism: FiveBar, rng: np.random.Generator) -> tuple[float, ...]:
    """Largest errors over the workspace, mm, of draws from the Cramer-Rao bound with prior (van Trees).

    Its covariance is C = (J' J + W)^-1, J the whitened Jacobian at the true machine and W the information of
    the tolerances and references.  The zeros are as uncertain as C says, the geometry stays as it was made.
    """
    truth = np.zeros(len(mechanism.parameters))
    truth[:SIZE] = machine.truth
    by_parameter = mechanism.observe(truth, mechanism.theta).by_parameter / mechanism.row_sd[:, None]
    root = tolerance_prior(mechanism).root
    covariance = np.linalg.inv(by_parameter.T @ by_parameter + root.T @ root)
    left = zeros_only(mechanism, covariance)
    at = mechanism.start
    at[:2] = 0.0
    jacobian: Real = mechanism.position_errors_at(at, machine.robot.workspace_grid(*GRID))[1]
    drawn = rng.multivariate_normal(np.zeros(SIZE), left[:SIZE, :SIZE], DRAWS, method="eigh")
    error = np.einsum("gdp,np->ngd", jacobian[:, :, :SIZE], drawn)
    return tuple(float(x) for x in np.sqrt((error**2).sum(axis=2)).max(axis=1))
