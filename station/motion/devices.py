"""Drivers made from the station file."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from drivers.errors import DeviceError
from drivers.lines import ModbusBus
from drivers.protocols import LinearScale, ServoAxis
from drivers.scales import HeidenhainND
from drivers.servos import LeadshineEL7
from station.errors import InputRefused
from station.settings import ScaleSettings, ServoSettings, Settings

log = logging.getLogger(__name__)

_Maker = TypeVar("_Maker")


@dataclass(frozen=True, slots=True)
class Devices:
    """Everything the station measures and moves with."""

    scale: LinearScale
    axes: tuple[ServoAxis, ServoAxis]
    addresses: tuple[str, str, str]
    """Where scale and axes hang, for people."""
    emulated: bool = False
    speed: float = 1.0
    """How much faster than real time the machine lives; 1 for a real one."""


def _heidenhain_nd(settings: ScaleSettings) -> LinearScale:
    scale = HeidenhainND(settings.url, timeout_s=settings.timeout_s)
    _say(scale.notice)
    return scale


def _leadshine_el7(settings: ServoSettings) -> tuple[ServoAxis, ServoAxis]:
    bus = ModbusBus(settings.url, timeout_s=settings.timeout_s)
    _say(bus.notice)
    first, second = (
        LeadshineEL7(bus, joint.unit, joint.scaling, name=f"servo axis {number}")
        for number, joint in enumerate(settings.joint, start=1)
    )
    return first, second


SCALES: dict[str, Callable[[ScaleSettings], LinearScale]] = {"heidenhain-nd": _heidenhain_nd}
SERVOS: dict[str, Callable[[ServoSettings], tuple[ServoAxis, ServoAxis]]] = {"leadshine-el7": _leadshine_el7}


def build_devices(settings: Settings, *, emulated: bool = False, speed: float = 1.0) -> Devices:
    """Drivers for the scale and both axes; nothing is opened yet.

    :raises InputRefused: no devices named, an unknown protocol, or an address that cannot be used.
    """
    scale, servo = settings.scale, settings.servo
    if scale is None or servo is None:
        raise InputRefused("The station file names no devices; it needs [scale] and [servo].")
    try:
        make_scale = _known(SCALES, scale.protocol, "[scale] protocol")
        make_axes = _known(SERVOS, servo.profile, "[servo] profile")
        first, second = (f"{servo.url} unit {joint.unit}" for joint in servo.joint)
        return Devices(
            scale=make_scale(scale),
            axes=make_axes(servo),
            addresses=(scale.url, first, second),
            emulated=emulated,
            speed=speed,
        )
    except DeviceError as error:
        raise InputRefused(str(error)) from error


def _known(makers: dict[str, _Maker], name: str, where: str) -> _Maker:
    if name not in makers:
        raise InputRefused(f'{where} "{name}" does not exist; there is {", ".join(sorted(makers))}.')
    return makers[name]


def _say(notice: str | None) -> None:
    if notice:
        log.warning("%s", notice)
