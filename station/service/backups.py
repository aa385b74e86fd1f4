"""Backups of the history made by the station itself: on request, and on time."""

from __future__ import annotations

import logging
import re
import time
from datetime import UTC, datetime
from pathlib import Path
from threading import Event, Thread
from typing import Self

from station.errors import InputRefused, StoreUnavailable
from station.records import BackupMade
from station.settings import BackupSettings
from station.store import Store

log = logging.getLogger(__name__)

RETRY_S = 600.0
_OURS = re.compile(r"station-\d{8}T\d{9}Z\.db")


def make_backup(store: Store, folder: Path, keep: int) -> BackupMade:
    """One more backup in a folder, of which the newest `keep` stay; the others are deleted, on record.

    :raises InputRefused: it cannot be written.
    """
    now = datetime.now(UTC)
    target = folder / f"station-{now:%Y%m%dT%H%M%S}{now.microsecond // 1000:03d}Z.db"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        store.backup(target)
        old = made_in(folder)[:-keep]
        for file in old:
            file.unlink()
    except OSError as error:
        raise InputRefused(f"The backup folder {folder} cannot be used: {error.strerror}.") from error
    made = BackupMade(file=str(target), bytes=target.stat().st_size, made_at=now)
    store.add_event(None, "backup", {"file": made.file, "deleted": [file.name for file in old]})
    return made


def made_in(folder: Path) -> list[Path]:
    """The station's own backups in a folder, oldest first."""
    return sorted(file for file in folder.glob("station-*.db") if _OURS.fullmatch(file.name))


class BackupTimer:
    """Makes a backup as soon as the newest one is too old, and from then on at intervals."""

    def __init__(self, store: Store, folder: Path, settings: BackupSettings) -> None:
        self._store, self._folder, self._keep = store, folder, settings.keep
        self._every_s = None if settings.every_h is None else 3600.0 * settings.every_h
        self._closing = Event()
        self._thread = Thread(target=self._run, name="backups", daemon=True)

    def __enter__(self) -> Self:
        if self._every_s is not None:
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        assert self._every_s is not None
        wait_s = self._first_wait_s(self._every_s)
        while not self._closing.wait(wait_s):
            wait_s = self._every_s
            try:
                make_backup(self._store, self._folder, self._keep)
            except (InputRefused, StoreUnavailable) as error:
                log.error("No backup was made: %s", error)
                wait_s = min(wait_s, RETRY_S)

    def _first_wait_s(self, every_s: float) -> float:
        newest = made_in(self._folder)[-1:]
        age_s = time.time() - newest[0].stat().st_mtime if newest else every_s
        return every_s - age_s if 0.0 <= age_s < every_s else 0.0
