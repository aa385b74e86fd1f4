"""Common commands of all servo drives: angles and speeds in their units, and refusals in words."""

from __future__ import annotations

import math
from dataclasses import dataclass

from drivers.errors import DeviceFault
from drivers.protocols import AxisStatus
from drivers.scaling import JointScaling

_RPM_PER_DEG_S = 1 / 6


@dataclass(frozen=True, slots=True)
class JointCommands:
    """Commands for one axis whose drive counts signed 32-bit pulses and can only declare its own zero."""

    name: str
    scaling: JointScaling
    max_rpm: int
    """Maximum speed of the motor."""

    @property
    def title(self) -> str:
        """Name of the axis for the beginning of a sentence."""
        return self.name[:1].upper() + self.name[1:]

    def pulses(self, theta_deg: float) -> int:
        """:raises DeviceFault: the angle is not a number, or has more pulses than the drive can count"""
        if not math.isfinite(theta_deg):
            raise DeviceFault(f"{self.title} was asked to move to {theta_deg}.")
        pulses = self.scaling.to_pulses(theta_deg)
        if not -(2**31) <= pulses < 2**31:
            raise DeviceFault(
                f"{self.title} cannot be told {theta_deg:g} deg; that is more pulses than it counts."
            )
        return pulses

    def rpm(self, speed_deg_s: float) -> int:
        """Motor speed: link speed times gear ratio, deg/s to revolutions per minute.

        :raises DeviceFault: the speed is zero, or higher than that of the motor
        """
        rpm = speed_deg_s * self.scaling.ratio * _RPM_PER_DEG_S
        if not 0 < rpm <= self.max_rpm:
            most = self.max_rpm / self.scaling.ratio / _RPM_PER_DEG_S
            raise DeviceFault(f"{self.title} was asked for {speed_deg_s:g} deg/s; 0 to {most:g} is possible.")
        return max(1, round(rpm))

    def refuse_on_alarm(self, status: AxisStatus) -> None:
        """:raises DeviceFault: an alarm is active"""
        if status.alarm is not None:
            raise DeviceFault(f"{self.title} shows alarm {status.alarm:X}h; find its cause, then reset it.")

    def check_zero_angle(self, theta_deg: float) -> None:
        """:raises DeviceFault: the angle differs from that of the drive's zero by more than half a pulse"""
        if abs(theta_deg - self.scaling.zero_at_deg) * self.scaling.pulses_per_deg > 0.5:
            raise DeviceFault(
                f"{self.title} can only be declared to stand at {self.scaling.zero_at_deg:g} deg,"
                f" where its drive's zero is, not at {theta_deg:g} deg."
            )

    def refuse_while_moving(self, status: AxisStatus) -> None:
        """:raises DeviceFault: a zero cannot be set now"""
        if status.moving:
            raise DeviceFault(f"{self.title} is moving; its zero can be set at standstill only.")
