"""Machines drawn from the tolerances, and how far off they truly stand after a calibration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from station.five_bar import SIZE, FiveBar, Robot, Tolerances, inverse, perturbed
from station.identification import Identification
from station.plans import make_plan
from station.records import Complex, PlanName, Real, Stop
from station.studies.simulation import SimulatedMachine, true_positions

LARGEST_ZERO_OFFSET_DEG = 3.0
GRID = (13, 9)
"""Finer than the one that bounds are computed on."""


def robot_of(tolerance_mm: float) -> Robot:
    """The paper's robot, made to a tolerance."""
    return Robot(serial="drawn", tolerances=Tolerances(tolerance_mm, tolerance_mm), feedback_sd_deg=0.0)


@dataclass(frozen=True)
class Drawn:
    """One machine of a study."""

    robot: Robot
    truth: Real
    """(12,) errors in the order of `station.five_bar.error_model`, mm and rad."""
    seed: int

    def machine(self, number: int = 0) -> SimulatedMachine:
        """Ready to be measured; another `number` has other noise."""
        return SimulatedMachine(self.robot, self.truth, "whole pulses", 1000 * self.seed + number)

    def struck(self, rng: np.random.Generator) -> Drawn:
        """The same after a collision: both zero offsets are others."""
        truth = self.truth.copy()
        truth[:2] = zero_offsets(rng)
        return Drawn(self.robot, truth, self.seed)

    def largest_errors_mm(self, fit: Identification[FiveBar]) -> tuple[float, float]:
        """Over the workspace: with the zeros in the drives only, and with the commands of the model."""
        return largest_errors_mm(self.robot, fit, lambda theta: true_positions(self.robot, self.truth, theta))


def largest_errors_mm(
    robot: Robot, fit: Identification[FiveBar], stand: Callable[[Real], Complex]
) -> tuple[float, float]:
    """As `Drawn.largest_errors_mm`.

    :param stand: where P truly is, (K,) mm, with the drives at angles (K, 2), rad
    """
    target = robot.workspace_grid(*GRID)
    largest = []
    for geometry in (robot.geometry, perturbed(robot.geometry, fit.p[:SIZE])):
        theta = inverse(geometry, target) - fit.dtheta
        largest.append(float(np.abs(stand(theta) - target).max()))
    return largest[0], largest[1]


@cache
def stops_of(plan: PlanName, tolerance_mm: float) -> tuple[Stop, ...]:
    """Of a plan, for the robot made to a tolerance."""
    return make_plan(plan, robot_of(tolerance_mm)).stops


def zero_offsets(rng: np.random.Generator) -> Real:
    """(2,) rad."""
    return np.radians(rng.uniform(-LARGEST_ZERO_OFFSET_DEG, LARGEST_ZERO_OFFSET_DEG, 2))


def errors_of(robot: Robot, rng: np.random.Generator) -> Real:
    """(12,) of a machine made to the tolerances of a robot, mm and rad."""
    truth = np.zeros(SIZE)
    truth[:2] = zero_offsets(rng)
    truth[2:6] = rng.normal(0.0, robot.tolerances.e_mm, 4)
    truth[6:10] = rng.normal(0.0, robot.tolerances.link_mm, 4)
    truth[10:] = rng.normal(robot.drm, robot.drm_sd)
    return truth


def drawn(robot: Robot, seed: int) -> tuple[Drawn, np.random.Generator]:
    """Machine number `seed` of a robot's tolerances, and the generator for what happens to it."""
    rng = np.random.default_rng([seed, 16])
    return Drawn(robot, errors_of(robot, rng), seed), rng
