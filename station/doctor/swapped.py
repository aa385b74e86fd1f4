"""Exchanged plugs and addresses: each device is queried at the other one's address."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from drivers.errors import DeviceError
from drivers.protocols import Device
from station.errors import InputRefused
from station.five_bar import Robot
from station.motion import build_devices, outside_mm
from station.records import Angles
from station.settings import ScaleSettings, ServoSettings, Settings


def lines_exchanged(settings: Settings) -> str:
    """The device that answers on the other line; empty if there is none, or none can."""
    scale, servo = settings.scale, settings.servo
    if scale is None or servo is None:
        return ""
    scale_url = _elsewhere(scale.options.url, servo.options.url)
    servo_url = _elsewhere(servo.options.url, scale.options.url)
    if scale_url is None or servo_url is None:
        return ""
    found = []
    at_servos = ScaleSettings(
        protocol=scale.protocol, options=scale.options.model_copy(update={"url": scale_url})
    )
    if _answers(settings.model_copy(update={"scale": at_servos}), lambda devices: devices[0]):
        found.append("the scale answers on the line of the drives")
    at_scale = ServoSettings(
        profile=servo.profile,
        options=servo.options.model_copy(update={"url": servo_url}),
        joint=servo.joint,
    )
    if _answers(settings.model_copy(update={"servo": at_scale}), lambda devices: devices[1]):
        found.append("a drive answers on the line of the scale")
    return " and ".join(found)


def axes_exchanged(settings: Settings, robot: Robot, theta_deg: Angles) -> bool:
    """Whether the arm would be within its workspace if the drives' joints were exchanged."""
    first, second = (joint.scaling for joint in settings.joints)
    pulses = first.to_pulses(theta_deg[0]), second.to_pulses(theta_deg[1])
    exchanged = first.to_deg(pulses[1]), second.to_deg(pulses[0])
    return outside_mm(robot, exchanged) <= 0.0


def _elsewhere(url: str, at: str) -> str | None:
    """A URL with the port or host of another one, its own scheme and settings; None if impossible."""
    scheme, _, rest = url.partition("://")
    place, mark, options = rest.partition("?")
    other = at.partition("://")[2].partition("?")[0]
    if place.startswith("/") != other.startswith("/"):
        return None
    return f"{scheme}://{other}{mark}{options}"


def _answers(settings: Settings, device_of: Callable[[tuple[Device, ...]], Device]) -> bool:
    with suppress(InputRefused):
        devices = build_devices(settings)
        device = device_of((devices.scale, *devices.axes))
        with suppress(DeviceError):
            device.connect()
            device.close()
            return True
    return False
