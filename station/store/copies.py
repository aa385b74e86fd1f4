"""Copies of the whole history: before an update changes it, and to restore it."""

from __future__ import annotations

import sqlite3
from contextlib import closing, suppress
from datetime import UTC, datetime
from pathlib import Path

from station.errors import InputRefused

_BESIDE = ("", "-wal", "-shm", "-ends.json")
"""Files that belong to a database."""


def copy_to(source: sqlite3.Connection, target: Path) -> None:
    """A consistent copy in one file, written atomically; others may write meanwhile.

    :raises InputRefused: it cannot be written.
    """
    unfinished = target.with_name(f"{target.name}-new")
    try:
        unfinished.unlink(missing_ok=True)
        with closing(sqlite3.connect(unfinished)) as copy:
            source.backup(copy)
            copy.execute("PRAGMA journal_mode = DELETE")  # one file, without others beside it
        unfinished.rename(target)
    except (OSError, sqlite3.Error) as error:
        with suppress(OSError):
            unfinished.unlink(missing_ok=True)
        raise InputRefused(f"The backup {target} cannot be written: {error}.") from error


def move_aside(database: Path) -> Path | None:
    """Rename a database and its files; returns the new name, None if there was none.

    A remaining write-ahead log would be applied to the database that replaces it.

    :raises OSError:
    """
    # to the microsecond: a second restore within the same second must not replace the first one's copy
    now = datetime.now(UTC).strftime("%Y%m%dT%H%M%S.%fZ")
    aside = database.with_name(f"{database.stem}-replaced-{now}{database.suffix}")
    found = [suffix for suffix in _BESIDE if database.with_name(database.name + suffix).exists()]
    for suffix in found:
        database.with_name(database.name + suffix).rename(aside.with_name(aside.name + suffix))
    return aside if found else None
