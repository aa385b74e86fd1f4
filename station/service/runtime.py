"""The running station: settings, store, devices, orchestrator, opened and closed together."""

from __future__ import annotations

import fcntl
import logging
import os
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Self, cast

from station import __version__
from station.errors import InputRefused, StoreUnavailable
from station.motion import EmulatedRig, equipment
from station.outbox import Alarms, couriers
from station.records import BackupDrill, BackupMade, DeviceView, Interlock
from station.service.backup_drill import drill
from station.service.backups import backup_timer, listed, make_backup
from station.service.orchestrator import LiveEvent, Orchestrator
from station.service.retention import retention_timer
from station.service.settings_audit import record_settings
from station.service.training import TrainingDesk
from station.settings import OutboxSettings, Settings, backup_folder, database_path
from station.store import Store

log = logging.getLogger(__name__)

_SWITCH_S = 0.0005
"""Maximum time that a computing thread holds the interpreter while another waits: a stop, or a thread that
feeds the watchdog of a drive, must not wait for a fit. Python's own 5 ms add up to a quarter of a second on a
busy computer.
"""
LAST_HISTORY = "last-history"
"""File in the home folder: the database that was used last."""


@dataclass
class Runtime:
    """One process owns the rig of a home folder; all others send their requests to it."""

    settings: Settings
    home: Path
    store: Store
    orchestrator: Orchestrator
    _closing: ExitStack
    rig: EmulatedRig | None = None
    """The emulated machine; None with real devices."""
    training: TrainingDesk | None = None
    """Only with the emulated machine."""

    @classmethod
    def open(cls, settings: Settings, home: Path, emulate: Path | None = None) -> Self:
        """Take the rig, open the store, mark runs that a crash interrupted, start the orchestrator.

        :param emulate: rig file of the emulated machine, even when the station file names devices.
        :raises InputRefused: another process holds the rig, or something cannot be opened.
        """
        sys.setswitchinterval(_SWITCH_S)
        with ExitStack() as opened:
            opened.enter_context(holding(home))
            path = database_path(settings, home)
            _check_still_there(path, home)
            store = Store(path)
            opened.callback(store.close)
            (home / LAST_HISTORY).write_text(str(path.resolve()), encoding="utf-8")
            for calibration_id in store.interrupt_unfinished():
                log.warning("Run %d was cut off by the last stop of the station: interrupted", calibration_id)
            record_settings(store, settings)
            with_it = opened.enter_context(equipment(settings, home, emulate))
            settings, rig = with_it.settings, with_it.rig
            orchestrator = Orchestrator(with_it.devices, store, settings)
            opened.callback(orchestrator.shutdown)
            opened.enter_context(backup_timer(store, backup_folder(settings, home), settings.backup))
            opened.enter_context(retention_timer(store, settings.retention))
            opened.enter_context(_telling(store, orchestrator, settings.outbox))
            desk = None if rig is None else TrainingDesk(rig, store, lambda: orchestrator.running)
            return cls(settings, home, store, orchestrator, opened.pop_all(), rig, desk)

    def backup(self) -> BackupMade:
        """Make one more backup. :raises InputRefused: it cannot be written."""
        return make_backup(self.store, backup_folder(self.settings, self.home), self.settings.backup.keep)

    def backup_drill(self) -> BackupDrill:
        """Make one more backup, opened beside the history and compared. :raises InputRefused: as `backup`."""
        return drill(self.store, backup_folder(self.settings, self.home), self.settings.backup.keep)

    def backups(self) -> list[BackupMade]:
        """The station's own existing backups, newest first."""
        return listed(backup_folder(self.settings, self.home))

    def close(self) -> None:
        """Abort the active run, make the machine safe, release everything. Repeating it is harmless."""
        self._closing.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


@contextmanager
def _telling(store: Store, orchestrator: Orchestrator, settings: OutboxSettings) -> Iterator[None]:
    """Until the station stops, convert alarms to events and send events to their receivers."""
    alarms = Alarms(store)

    def heard(event: LiveEvent) -> None:
        if isinstance(event.data, DeviceView):
            alarms.device(event.data)
        elif event.type == "interlock":
            alarms.interlocks(cast(tuple[Interlock, ...], event.data))

    with couriers(store, settings):
        unsubscribe = orchestrator.subscribe(heard)
        store.announce("station.started", {"version": __version__})
        try:
            yield
        finally:
            unsubscribe()
            with suppress(StoreUnavailable):
                store.announce("station.stopped", {})


def _check_still_there(path: Path, home: Path) -> None:
    """Refuse to start a new history in place of a missing one that was used here before.

    :raises InputRefused: the earlier history is missing.
    """
    note = home / LAST_HISTORY
    if not path.exists() and note.exists() and note.read_text(encoding="utf-8") == str(path.resolve()):
        raise InputRefused(
            f"The history {path}, used here before, is gone: mount its disk or restore a backup."
            f" To begin a new one, delete {note}."
        )


@contextmanager
def holding(home: Path) -> Iterator[None]:
    """Hold the rig of a home folder; it is released when the process ends for any reason.

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
    try:
        yield
    finally:
        os.close(lock)
