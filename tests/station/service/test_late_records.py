"""What was done already is recorded as soon as the database takes it."""

from __future__ import annotations

import sqlite3

import pytest

from station.errors import StoreUnavailable
from station.records import STATION
from station.service.late_records import LateRecords
from station.store.store import Store


def test_what_the_database_never_took_stands_in_the_log(
    store: Store, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def locked(*_: object, **__: object) -> None:
        raise StoreUnavailable("locked")

    monkeypatch.setattr("station.service.late_records.PAUSE_S", 0.01)
    monkeypatch.setattr(store, "record", locked)
    records = LateRecords(store)
    written = records.deed(STATION, "station.stopped", "both axes")
    records.deed(STATION, "run.aborted", "run 1")
    records.close(0.05)
    assert not written.wait(0.05)
    assert "Not recorded: station.stopped by station, run.aborted by station" in caplog.text


def test_a_stop_and_a_deed_are_written_in_order(store: Store) -> None:
    records = LateRecords(store)
    records.stop(None, "ada", {"axis 1": "no answer"})
    assert records.deed(STATION, "station.stopped", "both axes").wait(10.0)
    records.close(10.0)
    assert [entry.action for entry in store.audit()] == ["station.stopped"]


def test_a_record_that_can_never_be_written_does_not_hold_up_those_after_it(
    store: Store, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def refused(*_: object) -> None:
        raise sqlite3.IntegrityError("events.kind may not be null")

    monkeypatch.setattr(store, "add_event", refused)
    records = LateRecords(store)
    records.stop(None, "ada", {})
    assert records.deed(STATION, "run.aborted", "run 1").wait(10.0)
    records.close(10.0)
    assert [entry.action for entry in store.audit()] == ["run.aborted"]
    assert "Not recorded: stop by ada" in caplog.text
    assert "events.kind may not be null" in caplog.text
