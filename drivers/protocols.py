"""The interfaces of a linear scale and a servo axis, with their errors.

Joint angles at this interface are degrees in the robot's nominal frame (P_0 at 0 and 180 deg); distances are
mm. Every device has the same life cycle: `connect`, `make_safe`, `close`; `make_safe` and `close` may be
called in any state, any number of times, and never raise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable


@dataclass(frozen=True, slots=True)
class AxisStatus:
    """The state of a drive at one moment."""

    enabled: bool
    moving: bool
    in_position: bool
    alarm: int | None
    """The drive's alarm code, None if it has none."""


@runtime_checkable
class Device(Protocol):
    """Life cycle shared by all devices."""

    @property
    def name(self) -> str:
        """Name for the operator, for instance "linear scale" or "servo axis 1"."""
        ...

    def connect(self) -> None:
        """Open the line and verify that the right device answers.

        :raises DeviceError: with the error and what to check.
        """
        ...

    def make_safe(self) -> None:
        """Bring the device to standstill.  Never raises."""
        ...

    def close(self) -> None:
        """Release the line.  Never raises."""
        ...


@runtime_checkable
class LinearScale(Device, Protocol):
    """A readout that follows the distance rho up to an unknown constant."""

    def read_mm(self) -> float:
        """The head's present value in mm.

        :raises DeviceError: there was a fault mark, silence, or a malformed line; a doubtful number is never
        returned.
        """
        ...


@runtime_checkable
class RegisterReader(Protocol):
    """A device on a Modbus line that also reads the registers of other units on that line."""

    def read_register(self, unit: int, address: int) -> int:
        """One holding register of a unit on the line, 0..65535.

        :raises DeviceError: the unit refuses, or does not answer.
        """
        ...


@runtime_checkable
class ServoAxis(Device, Protocol):
    """One positioning drive of an active joint."""

    def enable(self) -> None:
        """Power the axis and wait until it confirms. :raises DeviceError:"""
        ...

    def move_to(self, theta_deg: float, speed_deg_s: float) -> None:
        """Start an absolute move and return at once (one frame on the wire).

        :raises DeviceError: the move is refused, or the reply is missing and the read-back state disagrees.
        """
        ...

    def status(self) -> AxisStatus:
        """:raises DeviceError:"""
        ...

    def feedback_deg(self) -> float:
        """The encoder's joint angle, read after the stop.  :raises DeviceError:"""
        ...

    def reset_alarm(self) -> None:
        """Clear a resettable alarm.  :raises DeviceError: if it stays."""
        ...

    def quick_stop(self) -> None:
        """Stop now, ahead of any queued request on the same line.  :raises DeviceError:"""
        ...

    def preset(self, theta_deg: float) -> None:
        """Declare the present position to be `theta_deg` (writes the zero into the drive).

        :raises DeviceError: it is refused, the axis moves, or the value reads back different.
        """
        ...
