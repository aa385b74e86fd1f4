"""Opening the database file: the one writer, and as many readers as ask at the same time."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from threading import Lock
from typing import Any

from sqlite_utils import Database

from station.errors import InputRefused, StoreUnavailable
from station.store.health import first_damage
from station.store.migrations import APPLICATION_ID, migrations

_BUSY_MS = 5000


def open_writer(path: Path) -> Database:
    """Check whose it is and that it is whole; open or create; migrate.

    :raises InputRefused: damaged, empty, not a database, another program's, or from a newer station.
        The file is as it was.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists():
            _check(path)
        else:
            _begin(path)
        connection = _connect(path)
    except (OSError, sqlite3.Error) as error:
        raise InputRefused(f"The database {path} cannot be opened: {error}.") from error
    try:
        return _migrated(connection)
    except sqlite3.Error as error:
        connection.close()
        raise _unusable(path, error) from error


def _begin(path: Path) -> None:
    """A new history, whole from its first moment: an empty file is never one that a crash left behind."""
    new = path.with_name(f"{path.name}-new")
    new.unlink(missing_ok=True)
    with closing(_connect(new)) as connection:
        _migrated(connection)
    new.rename(path)


def _migrated(connection: sqlite3.Connection) -> Database:
    db = Database(connection)
    db.execute("PRAGMA journal_mode = WAL")
    db.execute("PRAGMA synchronous = FULL")
    migrations.apply(db)
    return db


def _unusable(path: Path, why: object) -> InputRefused:
    return InputRefused(
        f"The database {path} cannot be used: {why}; restore it from a backup or move it away."
    )


def _check(path: Path) -> None:
    """Without changing a byte of it.  :raises InputRefused:"""
    if not path.is_file():
        raise _unusable(path, "it is not a file")
    if not path.stat().st_size:
        raise _unusable(path, "it is empty")
    # where the last station closed it, nothing needs to be made beside it to read it
    closed = not path.with_name(f"{path.name}-wal").exists()
    address = f"{path.resolve().as_uri()}?mode=ro{'&immutable=1' if closed else ''}"
    with closing(sqlite3.connect(address, uri=True)) as connection:
        try:
            _check_owner(Database(connection), path)
            damage = first_damage(connection)
        except sqlite3.Error as error:
            raise _unusable(path, error) from error
    if damage:
        raise _unusable(path, f"it is damaged ({damage})")


def _check_owner(db: Database, path: Path) -> None:
    if db.execute("PRAGMA application_id").fetchone()[0] != APPLICATION_ID:
        raise InputRefused(f"The database {path} belongs to another program; choose another --home.")
    known = {migration.name for migration in migrations.pending(Database(memory=True))}
    if newer := [step.name for step in migrations.applied(db) if step.name not in known]:
        raise InputRefused(
            f"The database {path} was written by a newer station ({newer[0]}); update this one first."
        )


def _connect(path: Path) -> sqlite3.Connection:
    # Handed from thread to thread, never used by two at once: the lock and the pool see to that.
    connection = sqlite3.connect(path, check_same_thread=False)
    connection.execute(f"PRAGMA busy_timeout = {_BUSY_MS}")
    return connection


@contextmanager
def available(path: Path) -> Iterator[None]:
    """:raises StoreUnavailable: the database is locked, full, read-only or damaged."""
    try:
        yield
    except (sqlite3.OperationalError, sqlite3.DatabaseError) as error:
        if isinstance(error, sqlite3.IntegrityError | sqlite3.ProgrammingError):
            raise  # a mistake of ours, not of the file
        raise StoreUnavailable(f"{path.name}: {error}") from error


class Readers:
    """A pool of connections that can only read."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = Lock()
        self._idle: list[sqlite3.Connection] = []
        self._closed = False

    def one(self, sql: str, values: Sequence[Any] = ()) -> sqlite3.Row | None:
        """First row or None."""
        with self._borrowed() as connection:
            row: sqlite3.Row | None = connection.execute(sql, values).fetchone()
        return row

    def all(self, sql: str, values: Sequence[Any] = ()) -> list[sqlite3.Row]:
        """Every row."""
        with self._borrowed() as connection:
            return connection.execute(sql, values).fetchall()

    def damage(self) -> str | None:
        """What is wrong with the file, by a look at every page on the disk."""
        with available(self._path), closing(_connect(self._path)) as connection:
            return first_damage(connection)

    def copy(self, target: Path) -> None:
        """A consistent copy in one file.  :raises InputRefused: it cannot be written."""
        try:
            with closing(sqlite3.connect(target)) as copy, self._borrowed() as connection:
                connection.backup(copy)
        except (sqlite3.Error, StoreUnavailable) as error:
            raise InputRefused(f"The backup {target} cannot be written: {error}.") from error

    def close(self) -> None:
        """Close what is idle; what is in use closes when it is given back."""
        with self._lock:
            self._closed = True
            idle, self._idle = self._idle, []
        for connection in idle:
            connection.close()

    @contextmanager
    def _borrowed(self) -> Iterator[sqlite3.Connection]:
        with self._lock:
            connection = self._idle.pop() if self._idle else None
        if connection is None:
            with available(self._path):
                connection = _connect(self._path)
                connection.row_factory = sqlite3.Row
                connection.execute("PRAGMA query_only = ON")
        try:
            with available(self._path):
                yield connection
        finally:
            with self._lock:
                keep = not self._closed
                if keep:
                    self._idle.append(connection)
            if not keep:
                connection.close()
