"""Alive, ready, and what is missing."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import pytest

from drivers.errors import LinkLost
from tests.web.conftest import Service
from web.routes import health


def test_a_process_that_answers_is_alive(service: Service) -> None:
    assert service.client.get("/healthz").json() == {"status": "alive"}


def test_ready_when_devices_and_interlocks_are_well(service: Service) -> None:
    service.complete()
    answer = service.client.get("/readyz")
    assert (answer.status_code, answer.json()) == (200, {"status": "ready"})


def test_a_lost_device_is_named(service: Service) -> None:
    nothing = LinkLost("scale: nothing answers")
    for call in ("scale connect", "scale read"):  # the idle watch may have connected it already
        service.rig.script.fail(call, nothing)
    service.complete()
    answer = service.client.get("/readyz")
    assert answer.status_code == 503
    assert any("nothing answers" in text for text in answer.json()["missing"])
    assert service.client.get("/healthz").status_code == 200


def test_a_station_that_hangs_is_named(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(health, "LOOK_TIMEOUT_S", 0.1)
    monkeypatch.setattr(service.runtime.orchestrator, "snapshot", service.rig.released.wait)
    answer = service.client.get("/readyz")
    assert (answer.status_code, answer.json()["missing"]) == (503, ["the station does not answer"])
    service.rig.released.set()


def missing(service: Service) -> list[str]:
    answer = service.client.get("/readyz")
    texts: list[str] = answer.json().get("missing", [])
    assert answer.status_code == (503 if texts else 200)
    return texts


def test_a_database_that_is_gone_or_replaced_is_named(service: Service) -> None:
    service.complete()
    assert missing(service) == []
    path = service.runtime.store.path
    aside = path.with_name("aside.db")
    path.rename(aside)
    assert missing(service) == [f"the database {path} is gone; restart the station"]
    path.write_bytes(b"")
    assert missing(service) == [f"the database {path} is gone; restart the station"]
    path.write_bytes(aside.read_bytes())
    assert missing(service) == [f"the database {path} was replaced by another file; restart the station"]
    aside.rename(path)
    assert missing(service) == []


def test_a_database_that_cannot_be_written_is_named(service: Service) -> None:
    service.complete()
    store = service.runtime.store
    store._writer.execute("PRAGMA busy_timeout = 10")
    with closing(sqlite3.connect(store.path)) as other:
        other.execute("BEGIN IMMEDIATE")
        assert missing(service) == ["the database cannot be used: station.db: database is locked"]
    assert missing(service) == []
    store._writer.execute("PRAGMA query_only = ON")
    assert missing(service) == [
        "the database cannot be used: station.db: attempt to write a readonly database"
    ]
    store._writer.execute("PRAGMA query_only = OFF")


def test_pages_that_turn_to_zeros_are_noticed(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.store.health.LEAST_PAUSE_S", 0.0)
    monkeypatch.setattr("station.store.health.SHARE_OF_TIME", 1e6)
    service.complete()
    store = service.runtime.store
    store._writer.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    assert missing(service) == []
    store._writer.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    with store.path.open("r+b") as file:
        file.seek(2 * 4096)
        file.write(bytes(store.path.stat().st_size - 2 * 4096))
    (found,) = missing(service)
    assert found.startswith(f"the database {store.path} is damaged (")
    assert found.endswith("; restore a backup")


def test_a_full_disk_is_named_and_no_run_starts(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    service.complete()
    full = service.runtime.settings.service.model_copy(update={"least_free_mb": 1e6})
    settings = service.runtime.settings.model_copy(update={"service": full})
    monkeypatch.setattr(service.runtime.orchestrator, "_settings", settings)
    (found,) = missing(service)
    assert "MB are free on the disk of" in found and found.endswith("1e+06 MB are needed")
    refused = service.start()
    assert (refused.status_code, refused.headers["retry-after"]) == (503, "5")
    assert "MB are free on the disk of" in refused.json()["detail"]
    assert len(service.client.get("/api/v1/calibrations").json()["items"]) == 1
