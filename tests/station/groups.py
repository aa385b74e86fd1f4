"""Machines to measure in tests: the paper's six groups and random ones, without wires."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from station.five_bar.error_model import perturbed, pose
from station.five_bar.kinematics import inverse
from station.five_bar.robot_file import Robot
from station.records import CalibrationResult, Complex, Measurements, Procedure, Reading, Real, Walk

DATA = Path(__file__).parents[3] / "shared" / "data"
needs_data = pytest.mark.skipif(not DATA.exists(), reason=f"the measured files are not at {DATA}")

ZERO_OFFSETS_DEG = {1: (2.0, -1.0), 2: (-1.0, 0.5), 3: (0.5, 0.25)}
GEOMETRIC_ERRORS_MM = np.array([0.03, -0.02, -0.02, 0.01, 0.01, 0.02, -0.03, -0.02])
"""e1x e1y e2x e2y L1 L2 l1 l2 of Table 2, groups 1 to 3; groups 4 to 6 have a tenth."""
DRM_MM = (1.0, 0.5)
PULSE_DEG = 0.0018
SCALE_SD_MM = 1.117e-3


def group(number: int) -> Real:
    """(12,) true deviations of one group of Table 2."""
    dtheta = np.radians(ZERO_OFFSETS_DEG[(number - 1) % 3 + 1])
    share = 1.0 if number <= 3 else 0.1
    return np.concatenate([dtheta, GEOMETRIC_ERRORS_MM * share, DRM_MM])


def readings_of(
    robot: Robot, truth: Real, theta_deg: Real, rng: np.random.Generator, samples: int = 1
) -> Real:
    """(K, samples) head readings of a machine standing at drive angles theta_deg (K, 2)."""
    at = pose(perturbed(robot.geometry, truth), np.radians(theta_deg) + truth[:2])
    return np.asarray(at.rho[:, None] - 600.0 + rng.normal(0.0, SCALE_SD_MM, (len(at.rho), samples)))


def measure(
    robot: Robot, truth: Real, places: Complex, rng: np.random.Generator, repeats: int = 1
) -> Measurements:
    """Each place read `repeats` times, joints standing on whole pulses."""
    places = np.repeat(places, repeats)
    theta_deg = np.round(np.degrees(inverse(robot.geometry, places)) / PULSE_DEG) * PULSE_DEG
    count = len(places)
    return Measurements(
        ids=tuple(range(1, count + 1)),
        t_s=np.arange(count, dtype=float),
        theta=np.radians(theta_deg),
        approach=np.zeros((count, 2), dtype=np.int8),
        distance=readings_of(robot, truth, theta_deg, rng)[:, 0],
        position=np.repeat(np.arange(count // repeats), repeats),
        mount=np.zeros(count, dtype=np.intp),
        samples=np.ones(count, dtype=np.intp),
    )


def calibrate(
    procedure: Procedure, robot: Robot, truth: Real, seed: int, samples: int = 5
) -> CalibrationResult:
    """Run a procedure to its end on a simulated machine."""
    rng = np.random.default_rng(seed)
    walk = next(procedure)
    number = 0
    while True:
        assert isinstance(walk, Walk)
        theta = np.array([stop.theta_deg for stop in walk.stops])
        theta = np.round(theta / PULSE_DEG) * PULSE_DEG
        taken: list[Reading] = []
        for stop, angles, values in zip(
            walk.stops, theta, readings_of(robot, truth, theta, rng, samples), strict=True
        ):
            number += 1
            taken.append(
                Reading(
                    reading=number,
                    t_s=float(number),
                    theta_deg=(float(angles[0]), float(angles[1])),
                    approach=stop.approach,
                    scale_mm=float(values.mean()),
                    position=stop.position,
                    walk=walk.number,
                    samples_mm=tuple(values.tolist()),
                )
            )
        try:
            walk = procedure.send(taken)
        except StopIteration as end:
            result = end.value
            assert isinstance(result, CalibrationResult)
            return result


def value_and_sd(result: CalibrationResult) -> tuple[Sequence[float], Sequence[float]]:
    """Zero offsets and their sd, deg."""
    return [q.value for q in result.zero_offsets], [q.sd for q in result.zero_offsets]
