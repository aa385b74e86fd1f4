"""Random machines with known effects, measured in virtual time.

The size of an effect is what is left of it in the readings after the kinematic parameters took their
share: its amplitude is scaled until a noise-free sequence leaves that residual.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from station.fitting import NotConvergedError, tolerance_prior
from station.five_bar import FiveBar, Robot
from station.mechanism import reference_of
from station.model import Model, fit
from station.plans import make_plan
from station.records import Measurements, Real
from station.studies.confusion.kinds import Cause, Make, Table, causes, errors
from station.studies.simulation import SimulatedMachine

SMALLEST_UM, LARGEST_UM = 1.0, 30.0
SCATTER_UM = 1.117
"""Noise of a reading."""
LARGEST_TIMES = 4.0
"""A part does not err by more than this many times its usual size, however little of it the readings show."""


@dataclass(frozen=True)
class Drawn:
    """One random machine, measured."""

    sequence: Measurements
    fresh: Measurements
    kinds: tuple[str, ...]
    truth: frozenset[Cause]
    """What the catalogue has of everything in it."""
    size_um: tuple[float, ...]
    """Projected RMS of each."""
    machine: SimulatedMachine
    """As it is after all readings."""


def draw(robot: Robot, kinds: tuple[str, ...], seed: int) -> Drawn:
    """A machine with one effect of each kind, at random sizes, joints, phases and moments."""
    rng = np.random.default_rng(seed)
    truth = _truth(robot, rng)

    def with_effects(effects: list[Table], *, noise: bool = True) -> SimulatedMachine:
        return SimulatedMachine(robot, truth, "whole pulses", seed, effects, noise=noise)

    stops = make_plan("diagnostic", robot).stops

    def left(make: Make, amplitude: float) -> float:
        silent = with_effects(make(amplitude), noise=False)
        return _left_um(robot, silent.run(stops))

    tables: list[Table] = []
    truth_of: set[Cause] = set()
    sizes = []
    for kind in kinds:
        make = errors(kind, rng)
        size = float(np.exp(rng.uniform(np.log(SMALLEST_UM), np.log(LARGEST_UM))))
        amplitude = scaled(partial(left, make), size)
        made = make(amplitude)
        tables += made
        truth_of |= causes(kind, made)
        sizes.append(left(make, amplitude) if amplitude == LARGEST_TIMES else size)
    machine = with_effects(tables)
    sequence, fresh = machine.diagnostic_run(robot, seed)
    return Drawn(sequence, fresh, kinds, frozenset(truth_of), tuple(sizes), machine)


def of_usual_size(robot: Robot, kinds: tuple[str, ...], seed: int) -> SimulatedMachine:
    """A machine with one effect of each kind, at the size that is usual for a part; not measured yet."""
    rng = np.random.default_rng(seed)
    truth = _truth(robot, rng)
    tables = [table for kind in kinds for table in errors(kind, rng)(1.0)]
    return SimulatedMachine(robot, truth, "whole pulses", seed, tables)


def _truth(robot: Robot, rng: np.random.Generator) -> Real:
    """(12,) errors, mm and rad; what the file says of the robot is true: else no interval could hold."""
    known = robot.tolerances
    zeros = rng.uniform(-np.radians(2.0), np.radians(2.0), 2)
    lengths = rng.normal(0.0, [known.e_mm] * 4 + [known.link_mm] * 4)
    return np.concatenate([zeros, lengths, rng.normal(robot.drm, robot.drm_sd)])


def scaled(left_um: Callable[[float], float], size_um: float) -> float:
    """The amplitude of which so much is left, as near as `LARGEST_TIMES` allows."""
    amplitude = 1.0
    for _ in range(3):
        left = left_um(amplitude)
        amplitude = min(amplitude * size_um / max(left, 1e-6), LARGEST_TIMES)
        if abs(left / size_um - 1.0) < 0.05:
            break
    return amplitude


def _left_um(robot: Robot, measured: Measurements) -> float:
    """Residual RMS of a noise-free sequence under the base model."""
    mechanism = FiveBar(robot, measured)
    try:
        base = fit(Model(mechanism, reference_of(measured)), tolerance_prior(mechanism), mechanism.row_sd)
    except NotConvergedError:
        return LARGEST_UM * 10.0  # far too large: the next amplitude will be smaller
    residual: Real = base.residual_mm
    return float(np.sqrt(np.mean(residual**2))) * 1e3
