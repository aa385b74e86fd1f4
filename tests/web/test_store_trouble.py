"""A database that is locked or damaged: starts are refused for now, nothing is shown that is not so."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime, timedelta

import pytest

from station.records import STATION
from tests.waiting import soon
from tests.web.conftest import Service

RUNS = "/api/v1/calibrations"


@pytest.fixture
def locked(service: Service, monkeypatch: pytest.MonkeyPatch) -> Iterator[sqlite3.Connection]:
    """Another program is writing."""
    service.runtime.store._writer.execute("PRAGMA busy_timeout = 10")
    with closing(sqlite3.connect(service.runtime.store.path)) as other:
        other.execute("BEGIN IMMEDIATE")
        yield other


def test_a_start_that_the_store_cannot_take_is_503_and_may_be_repeated(
    service: Service, locked: sqlite3.Connection
) -> None:
    refused = service.start(key="k")
    assert (refused.status_code, refused.headers["retry-after"]) == (503, "5")
    document = refused.json()
    assert document["type"] == "urn:station:problem:store-unavailable"
    assert document["detail"] == (
        "The history cannot be used at this moment (station.db: database is locked)."
        " Nothing was changed; try again."
    )
    assert service.client.get(RUNS).json()["items"] == [], "reading goes on"
    locked.rollback()
    assert service.start(key="k").status_code == 202


def test_an_end_that_is_not_stored_yet_is_not_shown_as_running(
    service: Service, locked: sqlite3.Connection
) -> None:
    locked.rollback()
    run = service.hold()
    locked.execute("BEGIN IMMEDIATE")
    service.client.post(f"{RUNS}/{run}/abort")
    service.runtime.orchestrator.wait(run, 10.0)
    shown = service.client.get(f"{RUNS}/{run}").json()
    assert (shown["state"], shown["verdict"], shown["outcome"]) == ("aborted", None, "aborted")
    assert service.client.get("/api/v1/station").json()["last"]["state"] == "aborted"
    assert [item["state"] for item in service.client.get(RUNS).json()["items"]] == ["aborted"]
    assert service.client.get(RUNS, params={"state": "running"}).json()["items"] == []


def test_a_busy_rig_says_when_to_ask_again(service: Service) -> None:
    service.hold()
    refused = service.start()
    assert (refused.status_code, refused.headers["retry-after"]) == (409, "5")


def test_a_stop_while_the_history_is_locked_is_in_the_audit_afterwards(
    service: Service,
    locked: sqlite3.Connection,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    """Locked for longer than a write waits: a hundredth of a second here, five seconds in the field."""
    monkeypatch.setattr("station.service.late_records.PAUSE_S", 0.01)
    monkeypatch.setattr("web.aside.RECORD_WAIT_S", 0.01)
    before = datetime.now(UTC)
    for name in ("ada", "bo"):
        answer = service.client.post("/api/v1/stop", headers={"X-Operator": name})
        assert answer.json()["confirmed"]
    after = datetime.now(UTC)
    soon(lambda: caplog.text.count("could not be recorded yet") >= 3)
    assert service.runtime.store.audit() == []
    locked.rollback()
    late = service.runtime.orchestrator.late_records.deed(STATION, "clock.looked", "at")
    assert late.wait(10.0), "in order: the stops are written by now"
    deeds = service.runtime.store.audit()[::-1]
    assert [(deed.action, deed.who) for deed in deeds[:2]] == [
        ("station.stopped", "ada"),
        ("station.stopped", "bo"),
    ]
    assert before - timedelta(milliseconds=1) <= deeds[0].at <= deeds[1].at <= after, "when it was done"
    assert service.runtime.store.check_audit().broken is None
