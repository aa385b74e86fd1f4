"""A plain machine, all stops at once: the emulated one without imperfections and without its clock.

A study of ten thousand machines has no time to follow each motion.  The geometry is that of
`drivers.emulated`, by the angles of a triangle; nothing of the identification is used.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from drivers.emulated.spec import MachineSpec
from station.five_bar import Robot
from station.records import Complex, Measurements, Real, Stop, number
from station.studies.simulation import SAMPLES

_SPEC = MachineSpec()
_BETWEEN_S = 4.0
"""From one reading to the next."""


@dataclass(frozen=True)
class PlainMachine:
    """Errors `truth` (12,) in the order of `station.five_bar.error_model`, mm and rad."""

    robot: Robot
    truth: Real
    aside_mm: complex = 0j
    """How far from the robot file's mounting point the mechanism is mounted."""

    def stand(self, theta: Real) -> Complex:
        """(K,) mm, where P is with the drives at theta (K, 2), rad."""
        turned = theta + self.truth[:2]
        base = np.array(self.robot.e) + self.truth[2:6].reshape(2, 2)
        arms = np.array(self.robot.L) + self.truth[6:8]
        first_mm, second_mm = np.array(self.robot.l) + self.truth[8:10]
        elbows = base + arms[:, None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1)
        apart = elbows[:, 1] - elbows[:, 0]
        distance = np.hypot(apart[:, 0], apart[:, 1])
        opening = np.arccos((first_mm**2 + distance**2 - second_mm**2) / (2 * first_mm * distance))
        towards_second = np.arctan2(apart[:, 1], apart[:, 0])
        points = np.stack(
            [
                elbows[:, 0] + first_mm * np.stack([np.cos(a), np.sin(a)], axis=-1)
                for a in (towards_second - opening, towards_second + opening)
            ]
        )
        lower = np.argmin(points[:, :, 1], axis=0)
        at = points[lower, np.arange(len(theta))]
        return np.asarray(at[:, 0] + 1j * at[:, 1])

    def read(self, stops: tuple[Stop, ...], rng: np.random.Generator) -> Measurements:
        """One reading at each stop, with the scatter of the servos and the noise of the head."""
        zero_deg = np.array(self.robot.zero_at_deg)
        commanded = (np.array([stop.theta_deg for stop in stops]) - zero_deg) * _SPEC.pulses_per_deg
        scatter = rng.normal(0.0, _SPEC.servo_error_pulses / 3, commanded.shape)
        theta = np.radians(zero_deg + np.round(np.round(commanded) + scatter) / _SPEC.pulses_per_deg)
        foot = complex(*np.array(self.robot.c) + np.array(self.robot.d) + self.truth[10:]) + self.aside_mm
        noise = rng.normal(0.0, _SPEC.scale_noise_mm, (len(stops), SAMPLES)).mean(axis=1)
        return Measurements(
            ids=tuple(range(1, len(stops) + 1)),
            t_s=_BETWEEN_S * np.arange(1.0, len(stops) + 1),
            theta=theta,
            approach=np.array([stop.approach for stop in stops], dtype=np.int8),
            distance=np.abs(self.stand(theta) - foot) - _SPEC.head_zero_mm + noise,
            position=number([stop.position for stop in stops])[0],
            mount=np.zeros(len(stops), dtype=np.intp),
            samples=np.full(len(stops), SAMPLES, dtype=np.intp),
        )
