"""Opening the database: check its owner and integrity, and bring it up to date."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

from sqlite_utils import Database

from station.errors import InputRefused
from station.store.connections import connect, connect_read_only
from station.store.copies import copy_to, move_aside
from station.store.health import first_damage
from station.store.migrations import APPLICATION_ID, migrations

SKIPPED = 1_000_000
"""Distance of the numbers of events before and after a restore: more than the events since any backup."""


def open_writer(path: Path) -> Database:
    """Check it, or begin a new one; migrate, after a copy of the old one.

    :raises InputRefused: the file is damaged, empty, not a database, another program's, or from a newer
    station. It is unchanged.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            _begin(path)
        elif older := check(path):
            with closing(connect_read_only(path)) as connection:
                copy_to(connection, path.with_name(f"{path.stem}-before-{older}{path.suffix}"))
        connection = connect(path)
    except (OSError, sqlite3.Error) as error:
        raise InputRefused(f"The database {path} cannot be opened: {error}.") from error
    try:
        return migrated(connection)
    except sqlite3.Error as error:
        connection.close()
        raise _unusable(path, error) from error


def check(path: Path) -> str | None:
    """The first migration that it lacks, None if it is up to date; the file is not changed.

    :raises InputRefused: the file is damaged, empty, not a database, another program's, or from a newer
    station.
    """
    if not path.is_file():
        raise _unusable(path, "it is not a file")
    if not path.stat().st_size:
        raise _unusable(path, "it is empty")
    try:
        with closing(connect_read_only(path)) as connection:
            db = Database(connection)
            _check_owner(db, path)
            if damage := first_damage(connection):
                raise _unusable(path, f"it is damaged ({damage})")
            return next((step.name for step in migrations.pending(db)), None)
    except sqlite3.Error as error:
        raise _unusable(path, error) from error


def restore(backup: Path, path: Path) -> Path | None:
    """Replace a database that is not in use by a backup.

    Returns the new name of the old database; None if there was none.

    :raises InputRefused: the backup cannot be used, or a file cannot be written; nothing has changed then.
    """
    check(backup)
    restored = path.with_name(f"{path.name}-restored")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with closing(connect_read_only(backup)) as connection:
            copy_to(connection, restored)
        _skip_numbers_of_events(restored)
        aside = move_aside(path)
        restored.rename(path)
    except (OSError, sqlite3.Error) as error:
        raise InputRefused(f"The database {path} cannot be restored: {error}.") from error
    return aside


def _skip_numbers_of_events(restored: Path) -> None:
    """A number of an event since the backup is never used again: who has seen it would miss the new event."""
    with closing(sqlite3.connect(restored)) as db, db:
        if db.execute("SELECT 1 FROM sqlite_master WHERE name = 'happenings'").fetchone():
            db.execute("UPDATE sqlite_sequence SET seq = seq + ? WHERE name = 'happenings'", [SKIPPED])


def migrated(connection: sqlite3.Connection) -> Database:
    """The database, brought up to date."""
    db = Database(connection)
    db.execute("PRAGMA journal_mode = WAL")
    db.execute("PRAGMA synchronous = FULL")
    migrations.apply(db)
    return db


def _begin(path: Path) -> None:
    """A new history, complete from its first moment: an empty file is never one that a crash left behind."""
    new = path.with_name(f"{path.name}-new")
    new.unlink(missing_ok=True)
    with closing(connect(new)) as connection:
        migrated(connection)
    move_aside(path)
    new.rename(path)


def _unusable(path: Path, why: object) -> InputRefused:
    return InputRefused(
        f"The database {path} cannot be used: {why}; restore it from a backup or move it away."
    )


def _check_owner(db: Database, path: Path) -> None:
    if db.execute("PRAGMA application_id").fetchone()[0] != APPLICATION_ID:
        raise InputRefused(f"The database {path} belongs to another program; choose another --home.")
    known = {migration.name for migration in migrations.pending(Database(memory=True))}
    if newer := [step.name for step in migrations.applied(db) if step.name not in known]:
        raise InputRefused(
            f"The database {path} was written by a newer station ({newer[0]}); update this one first."
        )
