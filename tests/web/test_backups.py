"""A backup over HTTP."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

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
