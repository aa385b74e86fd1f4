"""A backup over HTTP."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from station.store.store import Store
from tests.web.conftest import Service


def test_a_backup_is_made_while_a_run_is_under_way(service: Service) -> None:
    done, under_way = service.complete(), service.hold()
    answer = service.client.post("/api/v1/backups")
    assert answer.status_code == 201
    made = answer.json()
    file = Path(made["file"])
    assert (file.parent, file.stat().st_size) == (service.runtime.home / "backups", made["bytes"])
    with closing(Store(file, read_only=True)) as copy:
        assert copy.summary(done) == service.runtime.store.summary(done)
        assert copy.summary(under_way).state == "running"


def test_a_folder_that_cannot_be_written_is_a_refusal(service: Service) -> None:
    (service.runtime.home / "backups").touch()
    answer = service.client.post("/api/v1/backups")
    assert answer.status_code == 422
    assert "backup folder" in answer.json()["detail"]


def test_the_drill_compares_a_backup_with_the_history(service: Service) -> None:
    service.complete()
    answer = service.client.post("/api/v1/backups/drill")
    assert answer.status_code == 201
    drill = answer.json()
    assert (drill["passed"], drill["trouble"]) == (True, "")
    assert drill["chained_runs"] == 1 and drill["head"] and drill["audit_entries"] == 1
    rows = {table["table"]: table["backup"] for table in drill["tables"]}
    assert rows["calibrations"] == 1 and rows["readings"] > 0
    assert drill["restore"] == f"station restore {drill['backup']['file']}"
    listed = service.client.get("/api/v1/backups").json()["items"]
    assert [backup["file"] for backup in listed] == [drill["backup"]["file"]]


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        ("DELETE FROM readings WHERE reading = 1", "Run 1 of the backup: it is not as it ended."),
        ("DELETE FROM events", "another number of rows in events"),
        ("DROP TABLE chain", "no such table"),
    ],
)
def test_a_backup_that_is_not_the_history_fails_the_drill(
    service: Service, monkeypatch: pytest.MonkeyPatch, spoil: str, told: str
) -> None:
    service.complete()
    whole = service.runtime.store.backup

    def spoiled(target: Path) -> None:
        whole(target)
        with closing(sqlite3.connect(target)) as db, db:
            db.execute(spoil)

    monkeypatch.setattr(service.runtime.store, "backup", spoiled)
    service.client.post("/api/v1/stop")  # an event
    drill = service.client.post("/api/v1/backups/drill").json()
    assert not drill["passed"] and told in drill["trouble"]
