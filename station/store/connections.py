"""Connections to the database file: one writer, and one reader for each concurrent query."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from threading import Lock
from typing import Any

from station.errors import InputRefused, StoreUnavailable
from station.store.copies import copy_to
from station.store.health import first_damage

_BUSY_MS = 5000
ROWS_AT_ONCE = 4000
"""Number of rows that fits into the processor's cache."""


def connect(path: Path) -> sqlite3.Connection:
    """A connection passed between threads, never used by two at once: the lock and the pool ensure that."""
    connection = sqlite3.connect(path, check_same_thread=False)
    connection.execute(f"PRAGMA busy_timeout = {_BUSY_MS}")
    return connection


def connect_read_only(path: Path) -> sqlite3.Connection:
    """A read-only connection; it creates no file beside the database if no station has it open."""
    open_elsewhere = path.with_name(f"{path.name}-wal").exists()
    address = f"{path.resolve().as_uri()}?mode=ro{'' if open_elsewhere else '&immutable=1'}"
    connection = sqlite3.connect(address, uri=True, check_same_thread=False)
    connection.execute(f"PRAGMA busy_timeout = {_BUSY_MS}")
    return connection


@contextmanager
def available(path: Path) -> Iterator[None]:
    """:raises StoreUnavailable: the database is locked, full, read-only or damaged."""
    try:
        yield
    except (sqlite3.OperationalError, sqlite3.DatabaseError) as error:
        if isinstance(error, sqlite3.IntegrityError | sqlite3.ProgrammingError):
            raise  # a programming error, not one of the file
        raise StoreUnavailable(f"{path.name}: {error}") from error


class Readers:
    """A pool of read-only connections."""

    def __init__(self, path: Path, connect: Callable[[Path], sqlite3.Connection] = connect) -> None:
        self._path, self._connect = path, connect
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

    def columns(self, sql: str, values: Sequence[Any] = ()) -> Iterator[list[tuple[Any, ...]]]:
        """Every row in batches, converted to columns; nothing if there are no rows."""
        with self._borrowed() as connection:
            cursor = connection.cursor()
            cursor.row_factory = None
            cursor.execute(sql, values)
            while rows := cursor.fetchmany(ROWS_AT_ONCE):
                yield list(zip(*rows, strict=True))

    def damage(self) -> str | None:
        """The damage of the file, from a check of every page on the disk."""
        with available(self._path), closing(self._connect(self._path)) as connection:
            return first_damage(connection)

    def copy(self, target: Path) -> None:
        """A consistent copy in one file.  :raises InputRefused: it cannot be written."""
        try:
            with self._borrowed() as connection:
                copy_to(connection, target)
        except StoreUnavailable as error:
            raise InputRefused(f"The backup {target} cannot be written: {error}.") from error

    def close(self) -> None:
        """Close idle connections; those in use close when they are returned."""
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
                connection = self._connect(self._path)
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
