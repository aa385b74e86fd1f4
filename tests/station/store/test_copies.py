"""Backups, restores, copies before an update, and reading that changes nothing."""

from __future__ import annotations

import hashlib
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner
from sqlite_utils import Database

from station.cli import main
from station.errors import InputRefused, StoreUnavailable
from station.five_bar.robot_file import Robot
from station.records import State
from station.service import holding
from station.store import restore
from station.store.migrations import migrations
from station.store.store import Store
from tests.station.asking import asked

RELEASED = sorted((Path(__file__).parent / "released").glob("*.sqlite"))
ROBOT = Robot.default("R1")


def run_in(store: Store, state: State | None = State.ABORTED, serial: str = "R1") -> int:
    run = store.create(asked(serial, "rapid"), Robot.default(serial))
    if state is not None:
        store.finish(run, state)
    return run


def test_who_pulls_events_misses_none_after_a_restore(tmp_path: Path) -> None:
    path, backup = tmp_path / "station.db", tmp_path / "monday.db"
    with closing(Store(path)) as store:
        store.enqueue("mes", ("alarm",))
        store.announce("alarm", {"text": "before"})
        store.backup(backup)
        store.announce("alarm", {"text": "lost"})
        seen = store.happenings()[-1].n
    restore(backup, path)
    with closing(Store(path)) as store:
        store.announce("alarm", {"text": "after"})
        store.announce("alarm", {"text": "next"})
        store.enqueue("mes", ("alarm",))
        assert [event.n for event in store.happenings(after=seen)] == [1_000_002, 1_000_003]
        assert [delivery.event for delivery in store.deliveries()] == [1_000_003, 1_000_002, 1]


def station(home: Path, *arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["--home", str(home), *arguments])
    return result.exit_code, result.output


def digests(folder: Path) -> dict[str, str]:
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in folder.iterdir()}


def test_a_restore_is_one_command(tmp_path: Path) -> None:
    home, backup = tmp_path / "home", tmp_path / "monday.db"
    with closing(Store(home / "station.db")) as store:
        done = run_in(store)
        under_way = run_in(store, None)
        store.backup(backup)
        store.finish(under_way, State.ABORTED)
        later = store.summary(run_in(store, serial="R2"))
    code, output = station(home, "restore", str(backup))
    assert code == 0, output
    aside, interrupted, restored = output.splitlines()
    assert aside.startswith(f"The previous history is kept at {home / 'station-replaced-'}")
    assert interrupted == f"Run {under_way} was active at the time of the backup; it is now interrupted."
    assert restored == f"Restored {home / 'station.db'}; its newest run is {under_way}."
    with closing(Store(home / "station.db")) as store:
        newest = store.audit()[0]
        assert (newest.action, newest.subject, newest.via) == (
            "history.restored",
            "backup monday.db",
            "terminal",
        )
        assert [run.state for run in store.calibrations().items] == ["interrupted", "aborted"]
        assert store.summary(done).state == "aborted"
        again = store.summary(run_in(store, serial="R3"))
        assert (again.id, again.uid == later.uid) == (later.id, False)
    with closing(Store(next(home.glob("station-replaced-*.db")))) as store:
        assert store.summary(later.id).uid == later.uid
    assert backup.exists()


def test_two_restores_in_one_second_keep_both_histories(tmp_path: Path) -> None:
    path, backup = tmp_path / "station.db", tmp_path / "monday.db"
    with closing(Store(path)) as store:
        store.backup(backup)
        run_in(store, serial="R7")
    restore(backup, path)
    restore(backup, path)
    kept = []
    for aside in sorted(tmp_path.glob("station-replaced-*.db")):
        with closing(Store(aside)) as store:
            kept.append([run.robot_serial for run in store.calibrations().items])
    assert kept == [["R7"], []]


def test_a_restore_into_an_empty_home(tmp_path: Path) -> None:
    backup = tmp_path / "monday.db"
    with closing(Store(tmp_path / "station.db")) as store:
        store.backup(backup)
    code, output = station(tmp_path / "new", "restore", str(backup))
    assert (code, output) == (0, f"Restored {tmp_path / 'new' / 'station.db'}; it has no runs.\n")


def test_no_restore_while_the_service_runs_or_from_what_is_no_backup(tmp_path: Path) -> None:
    home, backup = tmp_path / "home", tmp_path / "monday.db"
    with closing(Store(home / "station.db")) as store:
        store.backup(backup)
    with holding(home):
        code, output = station(home, "restore", str(backup))
        assert code == 2 and "holds the rig" in output
    before = digests(home)
    damaged = tmp_path / "damaged.db"
    damaged.write_bytes(backup.read_bytes()[:8192] + bytes(8192) + backup.read_bytes()[16384:])
    for bad in (damaged, tmp_path / "station.toml"):
        bad.touch()
        code, output = station(home, "restore", str(bad))
        assert code == 2 and "cannot be used" in output
        assert digests(home) == before


def test_a_log_of_writes_without_its_database_is_not_applied_to_the_next(tmp_path: Path) -> None:
    path, backup = tmp_path / "station.db", tmp_path / "monday.db"
    store = Store(path)
    store.backup(backup)
    run_in(store)
    left = tmp_path / "left"
    left.mkdir()
    for file in tmp_path.glob("station.db-*"):
        shutil.copy(file, left)
    store.close()
    path.unlink()
    for file in left.iterdir():
        shutil.copy(file, tmp_path)
    assert restore(backup, path) is not None
    with closing(Store(path)) as store:
        assert store.calibrations().items == []


# Reading -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", [["runs"], ["show", "1"], ["export", "1"], ["memory", "R1"]])
def test_reading_commands_change_no_byte(tmp_path: Path, command: list[str]) -> None:
    with closing(Store(tmp_path / "station.db")) as store:
        run_in(store)
    before = digests(tmp_path)
    code, output = station(tmp_path, *command)
    assert code == 0, output
    assert digests(tmp_path) == before


def test_a_store_that_is_open_for_reading_sees_what_a_running_one_writes_and_writes_nothing(
    tmp_path: Path,
) -> None:
    with (
        closing(Store(tmp_path / "station.db")) as store,
        closing(Store(tmp_path / "station.db", read_only=True)) as reading,
    ):
        run = run_in(store)
        assert reading.summary(run) == store.summary(run)
        with pytest.raises(StoreUnavailable, match="readonly"):
            reading.add_event(None, "nothing")


@pytest.mark.parametrize("released", RELEASED, ids=lambda file: str(file.stem))
def test_a_file_of_an_older_station_is_read_without_updating_it(tmp_path: Path, released: Path) -> None:
    shutil.copy(released, tmp_path / "station.db")
    before = digests(tmp_path)
    with closing(Store(tmp_path / "station.db", read_only=True)) as store:
        runs = store.calibrations().items
        with closing(sqlite3.connect(released)) as original:
            (count,) = original.execute("SELECT count(*) FROM readings").fetchone()
        assert sum(len(store.readings(run.id)) for run in runs) == count
        assert len({run.uid for run in runs}) == len(runs) > 0
    assert digests(tmp_path) == before


# Updates -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("released", RELEASED, ids=lambda file: str(file.stem))
def test_an_update_keeps_a_copy_of_what_was_there(tmp_path: Path, released: Path) -> None:
    path = tmp_path / "station.db"
    shutil.copy(released, path)
    Store(path).close()
    Store(path).close()
    (copy,) = tmp_path.glob("station-before-*.db")
    with closing(sqlite3.connect(copy)) as kept, closing(sqlite3.connect(released)) as original:
        assert list(kept.iterdump()) == list(original.iterdump())
    assert copy.name == f"station-before-{lacking(released)[0]}.db"


def lacking(file: Path) -> list[str]:
    """The migrations that a file has not seen."""
    with closing(sqlite3.connect(file)) as connection:
        return [step.name for step in migrations.pending(Database(connection))]


def test_an_update_that_cannot_be_copied_before_is_not_made(tmp_path: Path) -> None:
    path = tmp_path / "station.db"
    shutil.copy(RELEASED[0], path)
    (tmp_path / f"station-before-{lacking(path)[0]}.db-new").mkdir()
    before = path.read_bytes()
    with pytest.raises(InputRefused, match="cannot be written"):
        Store(path)
    assert path.read_bytes() == before
