"""Failures of the history's disk: full, in error, locked by another program, cut off by a kill."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any, Literal

from station.simulation.scheduler import Scheduler

DiskTrouble = Literal["full", "error", "locked"]
_TEXTS: dict[DiskTrouble, str] = {
    "full": "database or disk is full",
    "error": "disk I/O error",
    "locked": "database is locked",
}
FOR_GOOD = 1_000_000
"""More writes than any run makes."""
_WRITES = ("INSERT", "UPDATE", "DELETE", "BEGIN IMMEDIATE", "COMMIT", "REPLACE")
_MOST_TORN_BYTES = 4000


class Disk:
    """Replaces the module `sqlite3`: real databases, whose writes fail on request."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.writes = 0
        """Number of writing calls so far."""
        self._fails: tuple[DiskTrouble, int, int] | None = None

    def fail(self, trouble: DiskTrouble, *, after: int, times: int) -> None:
        """This many writes from now succeed, then this many fail."""
        self._fails = (trouble, self.writes + after, self.writes + after + times)

    def mend(self) -> None:
        """Every write succeeds again."""
        self._fails = None

    def connect(self, *args: Any, **kwargs: Any) -> sqlite3.Connection:
        """As `sqlite3.connect`."""
        connection = sqlite3.connect(*args, factory=_Connection, **kwargs)
        connection.watch = self._call
        return connection

    def _call(self, sql: str) -> None:
        if not sql.lstrip().upper().startswith(_WRITES):
            return
        self._scheduler.give_way()
        self.writes += 1
        if self._fails is not None:
            trouble, first, end = self._fails
            if first <= self.writes - 1 < end:
                raise sqlite3.OperationalError(_TEXTS[trouble])

    def __getattr__(self, name: str) -> Any:
        return getattr(sqlite3, name)


class _Connection(sqlite3.Connection):
    watch: Callable[[str], None] = staticmethod(lambda _: None)

    def execute(self, sql: str, *args: Any) -> sqlite3.Cursor:
        self.watch(sql)
        return super().execute(sql, *args)


class CutOff:
    """The content of the disk at a power failure: a copy, restored after the process has ended."""

    def __init__(self, home: Path, aside: Path, random: Random) -> None:
        """:param home: home folder of the station; :param aside: a folder that does not exist yet"""
        self._home, self._aside = home, aside
        shutil.copytree(home, aside, ignore=shutil.ignore_patterns("*-shm", "backups"))
        for log in aside.glob("*-wal"):  # a write in progress leaves a part of a frame
            with log.open("ab") as out:
                out.write(random.randbytes(random.randrange(_MOST_TORN_BYTES)))

    def put_back(self) -> None:
        """Restore the copy: later writes of the ended process are discarded."""
        for file in self._home.iterdir():
            if file.is_file():
                file.unlink()
        shutil.copytree(self._aside, self._home, dirs_exist_ok=True)
        shutil.rmtree(self._aside)
