"""The open database file: one writer behind a lock, readers beside it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import RLock

from sqlite_utils import Database

from station.errors import InputRefused
from station.store.connections import Readers, available, connect, connect_read_only
from station.store.copies import copy_to
from station.store.health import Health
from station.store.opening import check, migrated, open_writer


class KeptFile:
    """Base of the store; each part adds the methods for its own tables."""

    def __init__(self, path: Path, *, read_only: bool = False) -> None:
        """Open or create the database and bring it up to date.

        :param read_only: do not change it; a database of an older station is read through a copy.
        :raises InputRefused: the file is not a database, not the station's, or from a newer station.
        """
        self.path = path
        self.opened = path
        """The file that is read; for an older database opened read-only, a copy."""
        self._lock = RLock()  # a transaction of several steps takes it again
        self._closing = ExitStack()
        if read_only:
            path = self._up_to_date(path)
            self.opened = path
            self._writer = Database(connect_read_only(path))  # refuses to write, with a message
            self._readers = Readers(path, connect_read_only)
        else:
            self._writer = open_writer(path)
            self._readers = Readers(path)
        self._closing.callback(self._writer.close)
        self._closing.callback(self._readers.close)
        self._health = Health(path, self._readers.damage, self._write_nothing)

    def troubles(self) -> list[str]:
        """Troubles that prevent the history from being read and written, one sentence each."""
        return self._health.troubles()

    def _write_nothing(self) -> None:
        """A real write to the disk without a change: the first page, with an otherwise unused number."""
        with self._writing() as db:
            (times,) = db.execute("PRAGMA user_version").fetchone()
            db.execute(f"PRAGMA user_version = {(times + 1) % 2**31}")

    def close(self) -> None:
        """Release the file."""
        with self._lock:
            self._closing.close()

    def _up_to_date(self, path: Path) -> Path:
        if not check(path):
            return path
        folder = Path(self._closing.enter_context(TemporaryDirectory()))
        with closing(connect_read_only(path)) as connection:
            copy_to(connection, folder / path.name)
        with closing(connect(folder / path.name)) as copy:
            migrated(copy)
        return folder / path.name

    def backup(self, target: Path) -> None:
        """Copy everything stored so far to one new file while the station works.

        :raises InputRefused: the file exists or cannot be written.
        """
        if target.exists():
            raise InputRefused(f"{target} exists already; a backup never overwrites.")
        self._readers.copy(target)

    @contextmanager
    def _writing(self) -> Iterator[Database]:
        """One transaction; a nested one becomes part of the outer one.

        It takes the write lock at once: a transaction that reads before it writes is refused if another
        program wrote in between, however long it waits.

        :raises StoreUnavailable: nothing was written.
        """
        with self._lock, available(self.path):
            db = self._writer
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
