"""Devices that are at their target at once: what is left of a run's time is the station's own."""

from __future__ import annotations

import numpy as np

from drivers.protocols import AxisStatus
from station.five_bar import Robot, perturbed, pose
from station.motion import Devices
from station.studies.reproduce import true_errors

HEAD_ZERO_MM = 437.25


class InstantAxis:
    """A drive without inertia."""

    def __init__(self, name: str, theta_deg: float) -> None:
        self.name = name
        self.theta_deg = theta_deg
        self._enabled = False

    def connect(self) -> None: ...

    def make_safe(self) -> None: ...

    def close(self) -> None: ...

    def enable(self) -> None:
        self._enabled = True

    def move_to(self, theta_deg: float, speed_deg_s: float) -> None:
        self.theta_deg = theta_deg

    def status(self) -> AxisStatus:
        return AxisStatus(enabled=self._enabled, moving=False, in_position=True, alarm=None)

    def feedback_deg(self) -> float:
        return self.theta_deg

    def reset_alarm(self) -> None: ...

    def quick_stop(self) -> None: ...

    def preset(self, theta_deg: float) -> None:
        self.theta_deg = theta_deg


class InstantScale:
    """Reads the distance that group 3 of the paper has at the axes' angles."""

    name = "linear scale"

    def __init__(self, axes: tuple[InstantAxis, InstantAxis]) -> None:
        self._axes = axes
        self._truth = true_errors(3)
        self._geometry = perturbed(Robot.default().geometry, self._truth)

    def connect(self) -> None: ...

    def make_safe(self) -> None: ...

    def close(self) -> None: ...

    def read_mm(self) -> float:
        theta = np.radians([[axis.theta_deg for axis in self._axes]]) + self._truth[:2]
        return round(float(pose(self._geometry, theta).rho[0]) - HEAD_ZERO_MM, 4)


def instant_devices() -> Devices:
    """Two axes at home and a scale."""
    axes = (InstantAxis("servo axis 1", 0.0), InstantAxis("servo axis 2", 180.0))
    return Devices(InstantScale(axes), axes, ("instant", "instant", "instant"), emulated=True, speed=1000.0)
