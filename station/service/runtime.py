"""The running station: settings, store, devices, orchestrator, opened and closed together."""

from __future__ import annotations

import fcntl
import logging
import os
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from station.errors import InputRefused
from station.motion import EmulatedRig, build_devices
from station.service.orchestrator import Orchestrator
from station.settings import Settings, database_path
from station.store import Store

log = logging.getLogger(__name__)


@dataclass
class Runtime:
    """One process owns the rig of a home folder; everything else asks this one."""

    settings: Settings
    home: Path
    store: Store
    orchestrator: Orchestrator
    _closing: ExitStack
    rig: EmulatedRig | None = None
    """The emulated machine; None with real devices."""

    @classmethod
    def open(cls, settings: Settings, home: Path, emulate: Path | None = None) -> Self:
        """Take the rig, open the store, mark what a crash left behind, start the orchestrator.

        :param emulate: rig file of the emulated machine, even when the station file names devices.
        :raises InputRefused: another process holds the rig, or something cannot be opened.
        """
        with ExitStack() as opened:
            opened.callback(os.close, _own(home))
            store = Store(database_path(settings, home))
            opened.callback(store.close)
            for calibration_id in store.interrupt_unfinished():
                log.warning("Run %d was cut off by the last stop of the station: interrupted", calibration_id)
            emulated = emulate is not None or settings.scale is None
            speed = 1.0
            rig: EmulatedRig | None = None
            if emulated:
                rig = EmulatedRig(
                    emulate or settings.emulated.rig, home / "emulated-rig.json", settings.emulated.speed
                )
                opened.callback(rig.close)
                settings, speed = rig.settings(settings), rig.speed
            devices = build_devices(settings, emulated=emulated, speed=speed)

            orchestrator = Orchestrator(devices, store, settings)
            opened.callback(orchestrator.shutdown)
            return cls(settings, home, store, orchestrator, opened.pop_all(), rig)

    def close(self) -> None:
        """Abort what runs, make the machine safe, release everything.  Twice is harmless."""
        self._closing.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _own(home: Path) -> int:
    """Take the rig's lock; it is released with the process, however that ends.

    :raises InputRefused: another process holds it, or the folder cannot be written.
    """
    try:
        home.mkdir(parents=True, exist_ok=True)
        lock = os.open(home / "rig.lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
    except OSError as error:
        raise InputRefused(f"The data folder {home} cannot be used: {error.strerror}.") from error
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(lock)
        raise InputRefused(
            f"Another station process holds the rig of {home}; use its page, or end it first."
        ) from error
    return lock
