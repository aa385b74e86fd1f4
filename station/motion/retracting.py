"""The return into the workspace: slow, step by step; each step must reduce the distance."""

from __future__ import annotations

import math
from dataclasses import dataclass

from drivers.errors import DeviceError, DeviceFault
from station.errors import StepFailed
from station.motion.machine import Machine
from station.motion.positioner import Positioner
from station.motion.way_back import TOLERANCE_MM, outside_mm, way_back
from station.records import Stop

FASTEST_DEG_S = 5.0


@dataclass
class Retracting:
    """Brings the arm of one run back."""

    machine: Machine
    positioner: Positioner
    _scale_is_lost: bool = False

    def carry_out(self) -> float:
        """Move back; returns how far outside the arm was, mm, inf if the linkage did not close.

        The scale is monitored where it can be read: outside the workspace its head may be off the scale, and
        the arm must still return.

        :raises Cancelled: the run was stopped.
        :raises DeviceError: a drive failed.
        :raises StepFailed: no path is known, or a step did not reduce the distance.
        """
        positioner, robot = self.positioner, self.positioner.robot
        stood_mm = distance_mm = outside_mm(robot, positioner.theta_deg)
        speed = min(FASTEST_DEG_S, self.machine.limits.speed_deg_s)
        for number, target in enumerate(way_back(robot, positioner.theta_deg), start=1):
            self.machine.moved(positioner.theta_deg, scale_mm := self._scale_mm())
            place = self.machine.place(target) or (0.0, 0.0)
            stop = Stop(f"{number} of the way back", place, target)
            positioner.go(stop, speed, scale=math.isfinite(scale_mm))
            before_mm, distance_mm = distance_mm, outside_mm(robot, positioner.theta_deg)
            if distance_mm > before_mm + TOLERANCE_MM:
                raise StepFailed(
                    f"Step {number} of the way back led away from the workspace, from {before_mm:.1f} mm to"
                    f" {distance_mm:.1f} mm outside; switch the drives off and look at the arm."
                )
        self.machine.moved(positioner.theta_deg, self._scale_mm())
        if distance_mm > 0.0:
            raise StepFailed(f"The arm still stands {distance_mm:.1f} mm outside its workspace.")
        return stood_mm

    def _scale_mm(self) -> float:
        """NaN if it cannot be read; after one missing answer it is not queried again, since the arm waits."""
        if self._scale_is_lost:
            return math.nan
        try:
            with self.machine.using(self.machine.devices.scale):
                return self.machine.devices.scale.read_mm()
        except DeviceError as error:
            self._scale_is_lost = not isinstance(error, DeviceFault)
            return math.nan
