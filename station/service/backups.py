"""Backups of the history made by the station itself: on request, and at intervals."""

from __future__ import annotations

import re
import time
from contextlib import AbstractContextManager, nullcontext
from datetime import UTC, datetime
from pathlib import Path

from station.errors import InputRefused
from station.records import BackupMade
from station.service.timer import Timer
from station.settings import BackupSettings
from station.store import Store

_OURS = re.compile(r"station-\d{8}T\d{9}Z\.db")


def make_backup(store: Store, folder: Path, keep: int) -> BackupMade:
    """Make one more backup in a folder. The newest `keep` are retained; others are deleted, with a record.

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


def listed(folder: Path) -> list[BackupMade]:
    """The same as records, the newest first."""
    return [
        BackupMade(file=str(file), bytes=found.st_size, made_at=datetime.fromtimestamp(found.st_mtime, UTC))
        for file in reversed(made_in(folder))
        for found in (file.stat(),)
    ]


def backup_timer(store: Store, folder: Path, settings: BackupSettings) -> AbstractContextManager[object]:
    """A timer that makes a backup as soon as the newest one is too old, and from then on at intervals."""
    if settings.every_h is None:
        return nullcontext()
    every_s = 3600.0 * settings.every_h
    return Timer(
        "backups", lambda: make_backup(store, folder, settings.keep), every_s, first_wait_s(folder, every_s)
    )


def first_wait_s(folder: Path, every_s: float) -> float:
    """Time until the newest backup is too old; zero if its date is in the future because of a wrong clock."""
    newest = made_in(folder)[-1:]
    age_s = time.time() - newest[0].stat().st_mtime if newest else every_s
    return every_s - age_s if 0.0 <= age_s < every_s else 0.0
