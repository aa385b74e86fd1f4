"""Under what the readings of a five-bar were taken, for the catalogue to work on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.effects import Conditions
from station.error_model import SIZE, distance_by_joint, perturbed, pose
from station.five_bar import FiveBar
from station.kinematics import Real
from station.measurements import Measurements

WARMED_BY_K = 0.05
"""A temperature column that moves less shows no warming."""
SAME_PLACE_RAD = 1e-6


@dataclass(frozen=True)
class Reference:
    """What later readings (the fresh ones) are counted from."""

    temperature_c: float | None
    theta: Real
    """(n,) where the joints stood last."""
    travel: float
    """What the head showed there, mm."""


def reference_of(measurements: Measurements) -> Reference:
    """Of the readings a model is learned on; `theta` is where they ended."""
    temperature = measurements.temperature_c
    warmed = temperature is not None and float(np.ptp(temperature)) > WARMED_BY_K
    return Reference(
        float(temperature[0]) if temperature is not None and warmed else None,
        measurements.theta[-1],
        float(measurements.distance[-1]),
    )


def conditions(mechanism: FiveBar, p: Real, reference: Reference, *, first: bool) -> Conditions:
    """Of the mechanism's readings at parameters p; `first` when the model is being learned on them."""
    m = mechanism.measurements
    robot = mechanism.robot
    theta = m.theta + p[:2]
    at = pose(perturbed(mechanism.nominal, p[:SIZE]), theta)
    by_joint = distance_by_joint(at)
    rise = None
    if reference.temperature_c is not None and m.temperature_c is not None:
        rise = m.temperature_c - reference.temperature_c
    before = _before(m, None if first else reference)
    return Conditions(
        t_s=m.t_s,
        theta=theta,
        drive_angle=m.theta - np.radians(robot.zero_at_deg),
        approach=m.approach.astype(float),
        travel=mechanism.observe(p, m.theta).value,
        slider_direction=_last_motion(m, by_joint, before),
        slider_net=_net_travel(m, before),
        temperature_rise=rise,
        payload_kg=m.payload_kg,
        lengths={"L1": robot.L[0], "L2": robot.L[1], "l1": robot.l[0], "l2": robot.l[1]},
        pull=pull(at.w),
    )


def _before(m: Measurements, reference: Reference | None) -> Real:
    """(K, n + 1) joint angles and distance before each reading, NaN where unknown."""
    came_from = np.array(m.came_from)
    if reference is not None:
        unknown = np.isnan(came_from).any(axis=1)
        came_from[unknown] = [*reference.theta, reference.travel]
    return came_from


def _last_motion(m: Measurements, by_joint: Real, before: Real) -> Real:
    """(K,) sign in which rho last changed: by the way from the reading before, or by the run-up where the
    recorded approach says that the last motion was another; 0 unknown."""
    way = m.theta - before[:, :-1]
    way[np.abs(way) < SAME_PLACE_RAD] = 0.0
    run_up = (m.approach != 0) & (m.approach != np.sign(way))
    last = np.where(run_up.any(axis=1)[:, None], m.approach, way)
    direction = np.sign(np.sum(by_joint * last, axis=1))
    return np.where(np.isnan(before).any(axis=1), 0.0, direction)


def _net_travel(m: Measurements, before: Real) -> Real:
    """(K,) sign of the change of reading, 0 unknown."""
    return np.nan_to_num(np.sign(m.distance - before[:, -1]))


def pull(w: np.ndarray) -> Real:
    """(K, 2) +1 where gravity pulls a distal link, -1 where it pushes: w_1 f_1 + w_2 f_2 = (0, -1)."""
    both = np.stack([w.real, w.imag], axis=1)
    down = np.tile([0.0, -1.0], (len(w), 1))
    return np.asarray(np.sign(np.linalg.solve(both, down[:, :, None])[:, :, 0]))
