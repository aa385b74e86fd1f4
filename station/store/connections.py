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
from station.store.migrations import APPLICATION_ID, migrations

_BUSY_MS = 5000


def open_writer(path: Path) -> Database:
    """Open or create, check whose it is, migrate.

    :raises InputRefused: not a database, another program's, or from a newer station.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        connection = _connect(path)
    except (OSError, sqlite3.Error) as error:
        raise InputRefused(f"The database {path} cannot be opened: {error}.") from error
    try:
        db = Database(connection)
        _check_owner(db, path)
        db.execute("PRAGMA journal_mode = WAL")
        db.execute("PRAGMA synchronous = FULL")
        migrations.apply(db)
    except sqlite3.Error as error:
        connection.close()
        raise InputRefused(
            f"The database {path} cannot be used: {error}; restore it from a backup or move it away."
        ) from error
    except InputRefused:
        connection.close()
        raise
    return db


def _check_owner(db: Database, path: Path) -> None:
    owner = db.execute("PRAGMA application_id").fetchone()[0]
    empty = not db.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
    if owner != APPLICATION_ID and not (owner == 0 and empty):
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
