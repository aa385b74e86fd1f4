"""The software and devices of a run of this station: stored with it before anything moves."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import version

from station import __version__
from station.motion import Devices
from station.records import DeviceUsed, MadeBy, ScaleCertificate
from station.settings import Settings

_COMPUTES = ("numpy", "scipy")


@cache
def _libraries() -> dict[str, str]:
    return {"python": platform.python_version()} | {name: version(name) for name in _COMPUTES}


def made_here(settings: Settings, devices: Devices) -> MadeBy:
    """The current software, devices and scale certificate."""
    drivers = (
        settings.scale.protocol if settings.scale else "",
        *[settings.servo.profile if settings.servo else ""] * 2,
    )
    named = [devices.scale.name, *(axis.name for axis in devices.axes)]
    certificate = settings.scale_certificate
    return MadeBy(
        station=settings.name,
        software=__version__,
        libraries=_libraries(),
        emulated=devices.emulated,
        devices=tuple(
            DeviceUsed(name=name, driver=driver, address=address)
            for name, driver, address in zip(named, drivers, devices.addresses, strict=True)
        ),
        scale_certificate=certificate and ScaleCertificate.model_validate(certificate.model_dump()),
    )
