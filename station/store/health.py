"""Whether the history can be read and written: the file is there, whole, and has room to grow."""

from __future__ import annotations

import shutil
import sqlite3
import time
from collections.abc import Callable
from pathlib import Path

from station.errors import StoreUnavailable

SHARE_OF_TIME = 0.02
"""Maximum share of time for checking every page, however large the file is."""
LEAST_PAUSE_S = 1.0


def first_damage(connection: sqlite3.Connection) -> str | None:
    """The first damage that SQLite's `quick_check` finds; None if the file is whole."""
    try:
        (found,) = connection.execute("PRAGMA quick_check(1)").fetchone()
    except sqlite3.DatabaseError as error:
        if isinstance(error, sqlite3.OperationalError):
            raise  # locked, for instance
        return str(error)
    return None if found == "ok" else " ".join(str(found).split())


def too_full(database: Path, least_free_mb: float) -> str | None:
    """Whether the disk has less free space than that; None if it has enough."""
    free_mb = shutil.disk_usage(database.parent).free / 1e6
    if free_mb >= least_free_mb:
        return None
    return f"only {free_mb:.1f} MB are free on the disk of {database}; {least_free_mb:g} MB are needed"


class Health:
    """Health of one open database."""

    def __init__(self, database: Path, look: Callable[[], str | None], write: Callable[[], None]) -> None:
        """:param look: checks every page; returns the damage, or None.
        :param write: writes without changing content.  :raises StoreUnavailable:
        """
        self._database = database
        self._opened = _identity(database)
        self._look, self._write = look, write
        self._damage: str | None = None
        self._next_look = 0.0

    def troubles(self) -> list[str]:
        """All troubles, one sentence each; empty if there are none."""
        if (identity := _identity(self._database)) != self._opened:
            what = "is gone" if identity is None else "was replaced by another file"
            return [f"the database {self._database} {what}; restart the station"]
        try:
            self._write()
            found = self._damaged()
        except StoreUnavailable as error:
            return [f"the database cannot be used: {error}"]
        return [f"the database {self._database} is damaged ({found}); restore a backup"] if found else []

    def _damaged(self) -> str | None:
        begun = time.monotonic()
        if begun >= self._next_look:
            self._damage = self._look()
            took = time.monotonic() - begun
            self._next_look = begun + max(LEAST_PAUSE_S, took / SHARE_OF_TIME)
        return self._damage


def _identity(path: Path) -> tuple[int, int] | None:
    try:
        status = path.stat()
    except OSError:
        return None
    return (status.st_dev, status.st_ino) if status.st_size else None
