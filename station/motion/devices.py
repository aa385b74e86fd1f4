"""Drivers created from the station file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from drivers.driver import Drive
from drivers.errors import DeviceError
from drivers.protocols import LinearScale, RegisterReader, ServoAxis
from drivers.scales import SCALES
from drivers.servos import SERVOS
from station.errors import InputRefused
from station.settings import Settings


@dataclass(frozen=True, slots=True)
class Devices:
    """All devices for measuring and moving."""

    scale: LinearScale
    axes: tuple[ServoAxis, ServoAxis]
    addresses: tuple[str, str, str]
    """Addresses of scale and axes, for people."""
    emulated: bool = False
    read_register: Callable[[int, int], int] | None = None
    """A holding register of a unit on the line of the drives; None if they are on no such line."""
    remount: Callable[[tuple[float, float], int], None] | None = None
    """Mounts the mechanism of the emulated machine at a point, with the number of the mounting there; None if
    a person does it.
    """
    speed: float = 1.0
    """Speed of the machine over real time; 1 for a real one."""


def build_devices(settings: Settings, *, emulated: bool = False, speed: float = 1.0) -> Devices:
    """Drivers for the scale and both axes; nothing is opened yet.

    :raises InputRefused: no devices are named, or an address cannot be used.
    """
    scale, servo = settings.scale, settings.servo
    if scale is None or servo is None:
        raise InputRefused("The station file names no devices; it needs [scale] and [servo].")
    drives = [
        Drive(f"servo axis {number}", joint.unit, joint.scaling)
        for number, joint in enumerate(servo.joint, start=1)
    ]
    first, second = (f"{servo.options.url} unit {drive.unit}" for drive in drives)
    try:
        axis1, axis2 = SERVOS[servo.profile].make(servo.options, drives)
        return Devices(
            scale=SCALES[scale.protocol].make(scale.options),
            axes=(axis1, axis2),
            addresses=(scale.options.url, first, second),
            read_register=axis1.read_register if isinstance(axis1, RegisterReader) else None,
            emulated=emulated,
            speed=speed,
        )
    except DeviceError as error:
        raise InputRefused(str(error)) from error
