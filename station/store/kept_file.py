"""The open database file: one writer behind a lock, readers beside it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import RLock

from sqlite_utils import Database

from station.errors import InputRefused
from station.store.connections import Readers, available, open_writer
from station.store.health import Health


class KeptFile:
    """Base of what is stored; each part of the store adds the methods for its own tables."""

    def __init__(self, path: Path) -> None:
        """Open or create the database and bring it up to date.

        :raises InputRefused: not a database, not the station's, or from a newer station.
        """
        self.path = path
        self._writer: Database = open_writer(path)
        self._lock = RLock()  # what is written in several steps, whole or not at all, takes it again
        self._readers = Readers(path)

        self._health = Health(path, self._readers.damage, self._write_nothing)

    def troubles(self) -> list[str]:
        """What keeps the history from being read and written, one sentence each."""
        return self._health.troubles()

    def _write_nothing(self) -> None:
        """To the disk all the same: the first page, with a number that nothing else uses."""
        with self._writing() as db:
            (times,) = db.execute("PRAGMA user_version").fetchone()
            db.execute(f"PRAGMA user_version = {(times + 1) % 2**31}")

    def close(self) -> None:
        """Release the file."""
        with self._lock:
            self._readers.close()
            self._writer.close()

    def backup(self, target: Path) -> None:
        """A copy of everything stored so far in one new file, made while the station works.

        :raises InputRefused: the file exists or cannot be written.
        """
        if target.exists():
            raise InputRefused(f"{target} exists already; a backup never overwrites.")
        self._readers.copy(target)

    @contextmanager
    def _writing(self) -> Iterator[Database]:
        """One transaction; what is written within another becomes part of that.

        It takes the write lock at once: a transaction that has read before it writes is refused when another
        program wrote in between, however long it would wait.

        :raises StoreUnavailable: nothing was written.
        """
        db = self._writer
        with self._lock, available(self.path):
            if db.conn.in_transaction:
                yield db
                return
            db.conn.execute("BEGIN IMMEDIATE")
            try:
                yield db
                db.conn.execute("COMMIT")
            except BaseException:
                db.conn.rollback()
                raise
