"""Whether the history can be used: one sentence for each trouble; every page is read only now and then."""

from __future__ import annotations

import shutil
import sqlite3
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from station.errors import StoreUnavailable
from station.store.health import LEAST_PAUSE_S, Health, first_damage, too_full


@pytest.fixture
def database(tmp_path: Path) -> Path:
    path = tmp_path / "station.db"
    with closing(sqlite3.connect(path)) as db, db:
        db.execute("CREATE TABLE t (x)")
        db.executemany("INSERT INTO t VALUES (?)", [["y" * 1000]] * 50)
    return path


def fine() -> None:
    return None


def test_a_whole_file_has_no_trouble(database: Path) -> None:
    assert Health(database, fine, fine).troubles() == []
    with closing(sqlite3.connect(database)) as db:
        assert first_damage(db) is None


def test_a_file_that_is_gone_or_replaced_is_named(database: Path, tmp_path: Path) -> None:
    kept = Health(database, fine, fine)
    shutil.copy(database, tmp_path / "other")
    (tmp_path / "other").replace(database)
    assert kept.troubles() == [f"the database {database} was replaced by another file; restart the station"]
    for undo in (lambda: database.write_bytes(b""), database.unlink):
        undo()
        assert kept.troubles() == [f"the database {database} is gone; restart the station"]


def test_damage_is_named_as_sqlite_finds_it(database: Path) -> None:
    with database.open("r+b") as file:
        file.seek(4096 + 8)
        file.write(bytes(3000))
    with closing(sqlite3.connect(database)) as db:
        found = first_damage(db)
    assert found is not None and found == " ".join(found.split())
    assert Health(database, lambda: found, fine).troubles() == [
        f"the database {database} is damaged ({found}); restore a backup"
    ]


def test_a_file_that_is_no_database_is_damage(tmp_path: Path) -> None:
    (tmp_path / "text").write_bytes(b"no database" * 1000)
    with closing(sqlite3.connect(tmp_path / "text")) as db:
        assert first_damage(db) == "file is not a database"


def test_a_store_that_takes_nothing_is_named(database: Path) -> None:
    def locked() -> None:
        raise StoreUnavailable("the disk is full")

    assert Health(database, fine, locked).troubles() == ["the database cannot be used: the disk is full"]


@pytest.mark.parametrize(("took_s", "pause_s"), [(0.0, LEAST_PAUSE_S), (0.5, 25.0)])
def test_reading_every_page_takes_two_per_cent_of_the_time(
    database: Path, monkeypatch: pytest.MonkeyPatch, took_s: float, pause_s: float
) -> None:
    now = 0.0
    looks: list[float] = []

    def look() -> str | None:
        nonlocal now
        looks.append(now)
        now += took_s
        return "torn" if len(looks) == 1 else None

    monkeypatch.setattr(time, "monotonic", lambda: now)
    kept = Health(database, look, fine)

    def damaged() -> bool:
        return bool(kept.troubles())

    assert damaged()
    now = pause_s - 0.01
    assert damaged() and looks == [0.0]
    now = pause_s
    assert not damaged() and looks == [0.0, pause_s]


@pytest.mark.parametrize(("free_mb", "said"), [(100.0, False), (99.9, True)])
def test_the_limit_of_free_space_is_met_exactly(
    database: Path, monkeypatch: pytest.MonkeyPatch, free_mb: float, said: bool
) -> None:
    usage: Callable[[Path], object] = lambda _: type("Usage", (), {"free": free_mb * 1e6})  # noqa: E731
    monkeypatch.setattr(shutil, "disk_usage", usage)
    found = too_full(database, 100)
    assert found == (f"only 99.9 MB are free on the disk of {database}; 100 MB are needed" if said else None)
