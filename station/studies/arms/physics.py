"""A serial arm by homogeneous matrices: no formula of the station's, forward only, effects where they act."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from station.records import Measurements, Real, with_guesses
from station.serial_arm import Arm

UR_LIKE = {
    "robot": {
        "serial": "A6",
        "model": "serial-dh",
        "a_mm": [0.0, -600.0, -570.0, 0.0, 0.0, 0.0],
        "d_mm": [130.0, 0.0, 0.0, 160.0, 115.0, 90.0],
        "alpha_deg": [90.0, 0.0, 0.0, 90.0, -90.0, 0.0],
    },
    "instrument": {"sd_mm": 0.02},
}
CRAIG_SEVEN = {
    "robot": {
        "serial": "A7",
        "model": "serial-dh",
        "convention": "modified",
        "a_mm": [0.0, 0.0, 0.0, 82.5, -82.5, 0.0, 88.0],
        "d_mm": [333.0, 0.0, 316.0, 0.0, 384.0, 0.0, 107.0],
        "alpha_deg": [0.0, -90.0, 90.0, 90.0, -90.0, 90.0, 90.0],
        "offset_deg": [0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    },
    "instrument": {"sd_mm": 0.02},
}
LIFTED = {
    "robot": {
        "serial": "L7",
        "model": "serial-dh",
        "joints": ["prismatic", *["revolute"] * 6],
        "a_mm": [0.0, 0.0, -600.0, -570.0, 0.0, 0.0, 0.0],
        "d_mm": [400.0, 130.0, 0.0, 0.0, 160.0, 115.0, 90.0],
        "alpha_deg": [0.0, 90.0, 0.0, 0.0, 90.0, -90.0, 0.0],
    },
    "instrument": {"sd_mm": 0.02},
}
"""On a lifting column."""
Joint = Callable[[Real], Real]
"""Angles of one joint (K,), rad -> what is added to them."""


def turn(axis: str, angle: float) -> Real:
    """4 x 4"""
    c, s = np.cos(angle), np.sin(angle)
    out = np.eye(4)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    out[i, i], out[i, j], out[j, i], out[j, j] = c, -s, s, c
    return out


def shift(axis: str, length: float) -> Real:
    """4 x 4"""
    out = np.eye(4)
    out["xyz".index(axis), 3] = length
    return out


@dataclass
class SimulatedArm:
    """One arm with errors, somewhere in front of a tracker that stands at the origin."""

    robot: Arm
    errors: Real
    """(n, 6): theta, d, a, alpha, b, beta of each link, mm and rad."""
    tool: Real
    effects: dict[int, Joint] = field(default_factory=dict)
    """By joint, from 1."""
    noise_mm: float = 0.02
    base: Real = field(
        default_factory=lambda: shift("x", 2200.0) @ shift("y", -900.0) @ turn("z", 0.7) @ turn("x", 0.1)
    )

    def position(self, theta: Real) -> Real:
        """(3,) of the target for joint angles theta (n,), rad."""
        r, at = self.robot, self.base
        for i in range(r.joints):
            dtheta, d, a, alpha, b, beta = self.errors[i]
            turned, slid = (0.0, 1000.0 * theta[i]) if i + 1 in r.sliding else (theta[i], 0.0)
            about_z = turn("z", turned + np.radians(r.offset_deg[i]) + dtheta) @ shift("z", slid + r.d[i] + d)
            about_x = shift("x", r.a[i] + a) @ turn("x", np.radians(r.alpha_deg[i]) + alpha)
            askew = shift("y", b) @ turn("y", beta)
            if r.convention == "standard":
                at = at @ about_z @ about_x @ askew
            else:
                about_x = turn("x", np.radians(r.alpha_deg[i]) + alpha) @ shift("x", r.a[i] + a)
                at = at @ about_x @ askew @ about_z
        return np.asarray((at @ np.append(self.tool, 1.0))[:3])

    def log(self, theta: Real, seed: int = 0) -> Measurements:
        """Readings at commanded angles theta (K, n), rad."""
        true = theta.copy()
        for joint, added in self.effects.items():
            true[:, joint - 1] += added(theta[:, joint - 1])
        rng = np.random.default_rng(seed)
        tracker = np.array([self.position(angles) for angles in true])
        tracker += rng.normal(0.0, self.noise_mm, tracker.shape)
        count = len(theta)
        return with_guesses(
            Measurements(
                ids=tuple(range(1, count + 1)),
                t_s=np.arange(count, dtype=float),
                theta=theta,
                approach=np.zeros(theta.shape, dtype=np.int8),
                distance=np.linalg.norm(tracker, axis=1),
                position=np.arange(count),
                mount=np.zeros(count, dtype=np.intp),
                samples=np.ones(count, dtype=np.intp),
                tracker=tracker,
                sliding=self.robot.sliding,
            )
        )


def random_arm(data: dict[str, object], seed: int, **effects: Joint) -> SimulatedArm:
    """Errors within tolerance; effects as j1=..., j2=..."""
    robot = Arm.from_dict(data)
    rng = np.random.default_rng(seed)
    scale = np.array([np.radians(0.2), 0.3, 0.3, np.radians(0.1), 0.3, np.radians(0.1)])
    errors = rng.normal(0.0, 1.0, (robot.joints, 6)) * scale
    return SimulatedArm(
        robot,
        errors,
        np.array([20.0, -35.0, 60.0]),
        {int(name[1:]): added for name, added in effects.items()},
    )


def random_poses(joints: int, count: int, seed: int, reach_deg: float = 120.0) -> Real:
    """(count, joints) rad"""
    return np.radians(np.random.default_rng(seed).uniform(-reach_deg, reach_deg, (count, joints)))
