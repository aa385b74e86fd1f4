"""The simulated machine of the tests: that of the studies, with its own physics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from station.five_bar.kinematics import inverse
from station.five_bar.robot_file import Robot
from station.records import (
    CalibrationResult,
    Complex,
    Measurements,
    MeasurementSequence,
    Procedure,
    Reading,
    Real,
)
from station.studies.simulation import SimulatedMachine

DATA = Path(__file__).parents[3] / "shared" / "data"
needs_data = pytest.mark.skipif(not DATA.exists(), reason=f"the measured files are not at {DATA}")

ROBOT = Robot.default()
ZERO_OFFSETS_DEG = {1: (2.0, -1.0), 2: (-1.0, 0.5), 3: (0.5, 0.25)}
GEOMETRIC_ERRORS_MM = np.array([0.03, -0.02, -0.02, 0.01, 0.01, 0.02, -0.03, -0.02])
"""e1x e1y e2x e2y L1 L2 l1 l2 of Table 2, groups 1 to 3; groups 4 to 6 have a tenth."""
DRM_MM = (1.0, 0.5)
DRAWN_OFFSETS_DEG = (1.1, -0.7)
"""Zero offsets of a `Drawn` machine."""
TEN = 10


def group(number: int) -> Real:
    """(12,) true deviations of one group of Table 2."""
    dtheta = np.radians(ZERO_OFFSETS_DEG[(number - 1) % 3 + 1])
    share = 1.0 if number <= 3 else 0.1
    return np.concatenate([dtheta, GEOMETRIC_ERRORS_MM * share, DRM_MM])


def measure(robot: Robot, truth: Real, places: Complex, seed: int, repeats: int = 1) -> Measurements:
    """Each position read `repeats` times, with joints on their commanded pulses."""
    places = np.repeat(places, repeats)
    labels = [f"P{k // repeats}" for k in range(len(places))]
    theta_deg = np.degrees(inverse(robot.geometry, places))
    return SimulatedMachine(robot, truth, "exact", seed).visit(theta_deg, labels)


def read(
    machine: SimulatedMachine, sequence: MeasurementSequence, before: int = 0, samples: int = 1
) -> list[Reading]:
    """A measurement sequence as a run records it, after this many readings."""
    taken = machine.run(sequence.stops, samples)
    return [
        Reading(
            before + k + 1,
            float(taken.t_s[k]),
            (float(np.degrees(taken.theta[k, 0])), float(np.degrees(taken.theta[k, 1]))),
            (int(taken.approach[k, 0]), int(taken.approach[k, 1])),
            float(taken.distance[k]),
            stop.position,
            sequence.number,
            # only their number is used
            (float(taken.distance[k]),) * samples if samples > 1 else (),
        )
        for k, stop in enumerate(sequence.stops)
    ]


def carried_out(
    machine: SimulatedMachine, procedure: Procedure, before: int = 0, samples: int = 1
) -> tuple[list[Reading], CalibrationResult]:
    """Carry out a procedure that only measures, to its end."""
    readings: list[Reading] = []
    try:
        sequence = next(procedure)
        while True:
            assert isinstance(sequence, MeasurementSequence)
            taken = read(machine, sequence, before + len(readings), samples)
            readings += taken
            sequence = procedure.send(taken)
    except StopIteration as end:
        return readings, end.value


def calibrated(procedure: Procedure, robot: Robot, truth: Real, seed: int) -> CalibrationResult:
    """The result of a procedure on a machine with errors `truth` (12,)."""
    return carried_out(SimulatedMachine(robot, truth, "exact", seed), procedure, samples=5)[1]


def value_and_sd(result: CalibrationResult) -> tuple[Sequence[float], Sequence[float]]:
    """Zero offsets and their sd, deg."""
    return [q.value for q in result.zero_offsets], [q.sd for q in result.zero_offsets]


class Drawn:
    """A machine with random errors within tolerance and effects as in its rig file."""

    def __init__(
        self,
        *effects: dict[str, Any],
        seed: int = 1,
        recorded_temperature: bool = True,
        tracked: bool = False,
    ) -> None:
        self._rng = np.random.default_rng(seed)
        small = self._rng.normal(0.0, 0.02, 8)
        drm = DRM_MM + self._rng.normal(0.0, 0.05, 2)
        truth = np.concatenate([np.radians(DRAWN_OFFSETS_DEG), small, drm])
        self._machine = SimulatedMachine(ROBOT, truth, "whole pulses", seed, effects, tracked=tracked)
        self.recorded_temperature = recorded_temperature
        self._count = 0

    def sequence(self) -> Measurements:
        """120 readings: ten positions three times each, a 9 x 5 grid forwards and backwards."""
        grid = ROBOT.workspace_grid(9, 5).reshape(9, 5).copy()
        grid[1::2] = grid[1::2, ::-1]
        there = grid.ravel()
        places = np.concatenate([np.tile(self._interior(TEN), 3), there, there[::-1]])
        across = [f"g{k}" for k in range(there.size)]
        return self._measure(places, [f"r{k}" for k in range(TEN)] * 3 + across + across[::-1])

    def fresh(self) -> Measurements:
        """40 readings at random interior positions."""
        return self._measure(self._interior(40), [f"f{k}" for k in range(40)])

    def stand(self, theta_deg: Real) -> Complex:
        """(K,) mm, true position of the platform at joint commands theta_deg (K, 2)."""
        return self._machine.stand(theta_deg)

    def _interior(self, count: int) -> Complex:
        (x0, x1), (y0, y1) = ROBOT.workspace_x, ROBOT.workspace_y
        return np.asarray(self._rng.uniform(x0, x1, count) + 1j * self._rng.uniform(y0, y1, count))

    def _measure(self, places: Complex, labels: Sequence[str]) -> Measurements:
        """One reading at each position, commanded by nominal geometry."""
        taken = self._machine.visit(np.degrees(inverse(ROBOT.geometry, places)), labels)
        first = self._count + 1
        self._count += len(taken)
        return replace(
            taken,
            ids=tuple(range(first, first + len(taken))),
            temperature_c=taken.temperature_c if self.recorded_temperature else None,
        )


def to_csv(measurements: Measurements) -> str:
    """As a measurement file."""
    m = measurements
    header = "reading,t_s,theta1_deg,theta2_deg,approach1,approach2,scale_mm,position"
    theta = np.degrees(m.theta)
    rows = [
        f"{m.ids[k]},{m.t_s[k]:.3f},{theta[k, 0]:.6f},{theta[k, 1]:.6f},"
        f"{m.approach[k, 0]},{m.approach[k, 1]},{m.distance[k]:.5f},{m.position[k]}"
        for k in range(len(m))
    ]
    return "\n".join([header, *rows, ""])
