"""Backups on request and on time."""

from __future__ import annotations

import os
import time
from contextlib import closing
from pathlib import Path

import pytest
from pydantic import JsonValue

from station.errors import InputRefused
from station.five_bar.robot_file import Robot
from station.service.backups import backup_timer, first_wait_s, made_in, make_backup
from station.settings import BackupSettings
from station.store.store import Store
from tests.station.asking import asked
from tests.waiting import soon

HOUR_S = 3600.0


def events(store: Store) -> list[dict[str, JsonValue]]:
    return [event.data for event in store.events(None) if event.kind == "backup"]


def test_the_newest_stay_and_what_is_deleted_is_on_record(store: Store, tmp_path: Path) -> None:
    run = store.create(asked("R1", "rapid"), Robot.default("R1"))
    folder = tmp_path / "backups"
    folder.mkdir()
    (folder / "station-monday.db").touch()  # not one of ours
    made = []
    for _ in range(3):
        made.append(make_backup(store, folder, keep=2))
        time.sleep(0.002)
    assert [str(file) for file in made_in(folder)] == [made[1].file, made[2].file]
    assert (folder / "station-monday.db").exists()
    first = Path(made[0].file).name
    assert [event["deleted"] for event in events(store)] == [[], [], [first]]
    assert made[2].bytes == Path(made[2].file).stat().st_size
    with closing(Store(Path(made[2].file), read_only=True)) as copy:
        assert copy.summary(run) == store.summary(run)


def test_a_folder_that_cannot_be_used_is_said(store: Store, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputRefused, match=r"^The backup folder .*file/backups cannot be used: "):
        make_backup(store, tmp_path / "file" / "backups", keep=2)


@pytest.mark.parametrize(
    ("age_h", "due"), [(None, True), (25.0, True), (1.0, False), (-87_600.0, True)], ids=str
)
def test_one_is_made_at_the_start_where_the_newest_is_too_old(
    store: Store, tmp_path: Path, age_h: float | None, due: bool
) -> None:
    """Or where it is of the future, after a clock that was wrong."""
    if age_h is not None:
        newest = Path(make_backup(store, tmp_path, keep=5).file)
        then = time.time() - age_h * HOUR_S
        os.utime(newest, (then, then))
    before = len(made_in(tmp_path))
    assert (first_wait_s(tmp_path, 24.0 * HOUR_S) == 0.0) is due
    with backup_timer(store, tmp_path, BackupSettings(every_h=24.0)):
        if due:
            soon(lambda: len(made_in(tmp_path)) > before)
    assert len(made_in(tmp_path)) == before + due


def test_one_follows_the_other(store: Store, tmp_path: Path) -> None:
    with backup_timer(store, tmp_path, BackupSettings(every_h=0.01 / HOUR_S, keep=100)):
        soon(lambda: len(made_in(tmp_path)) >= 3)


def test_without_an_interval_none_is_made(store: Store, tmp_path: Path) -> None:
    with backup_timer(store, tmp_path / "backups", BackupSettings()):
        pass
    assert not (tmp_path / "backups").exists()


def test_a_backup_that_fails_is_tried_again(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("station.service.timer.RETRY_S", 0.01)
    folder = tmp_path / "backups"
    folder.touch()
    with backup_timer(store, folder, BackupSettings(every_h=24.0)):
        soon(lambda: "cannot be used" in caplog.text)
        folder.unlink()
        soon(lambda: made_in(folder))
