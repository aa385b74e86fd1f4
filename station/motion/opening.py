"""The devices of a station, real or emulated, while they are needed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from station.motion.devices import Devices, build_devices
from station.motion.emulated_rig import EmulatedRig
from station.settings import Settings


@dataclass(frozen=True, slots=True)
class Equipment:
    """Devices, none of them opened yet, and their settings."""

    settings: Settings
    """Settings with the addresses of the emulated rig, if there is one."""
    devices: Devices
    rig: EmulatedRig | None
    """The emulated machine; None with real devices."""


@contextmanager
def equipment(settings: Settings, home: Path, emulate: Path | None) -> Iterator[Equipment]:
    """The devices of the station file, otherwise the emulated rig, which ends with the block.

    :param emulate: rig file of the emulated machine, even when the station file names devices.
    :raises InputRefused: the rig does not start, or an address cannot be used.
    """
    if emulate is None and settings.scale is not None:
        yield Equipment(settings, build_devices(settings), None)
        return
    rig = EmulatedRig(emulate or settings.emulated.rig, home / "emulated-rig.json", settings.emulated.speed)
    try:
        settings = rig.settings(settings)
        devices = build_devices(settings, emulated=True, speed=rig.speed)
        yield Equipment(settings, replace(devices, remount=rig.remount), rig)
    finally:
        rig.close()
