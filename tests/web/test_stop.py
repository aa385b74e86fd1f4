"""The stop works whatever else hangs."""

from __future__ import annotations

import sqlite3
import threading
from contextlib import closing
from pathlib import Path

import pytest

from drivers.errors import LinkLost
from tests.waiting import PATIENCE_S, soon
from tests.web.conftest import LIMIT_S, Service
from web.routes import stop as stop_route


def test_stop_reaches_both_axes_and_ends_the_run(service: Service) -> None:
    run = service.hold()
    answer = service.client.post("/api/v1/stop", headers={"X-Operator": "ada"})
    assert (answer.status_code, answer.json()) == (
        200,
        {"axes": {"axis 1": None, "axis 2": None}, "confirmed": True},
    )
    assert {"axis 1 quick_stop", "axis 2 quick_stop"} <= set(service.rig.script.calls)
    assert service.runtime.orchestrator.wait(run, LIMIT_S) == "aborted"


def test_stop_without_a_run_still_stops(service: Service) -> None:
    service.wait_for("scale read")
    assert service.client.post("/api/v1/stop").status_code == 200
    assert {"axis 1 quick_stop", "axis 2 quick_stop"} <= set(service.rig.script.calls)


def test_a_drive_that_is_not_connected_has_not_confirmed(service: Service) -> None:
    nothing = LinkLost("axis 1: nothing answers")
    service.rig.script.fail("axis 1 connect", nothing)
    service.rig.script.fail("axis 1 status", nothing)
    service.rig.script.fail("axis 1 quick_stop", nothing)
    soon(lambda: service.device("axis 1")["state"] == "lost")
    assert service.client.post("/api/v1/stop").status_code == 502


def test_stop_passes_a_worker_that_hangs_in_a_device(service: Service) -> None:
    ended = threading.Event()

    def hang() -> None:
        service.rig.released.wait(PATIENCE_S)
        ended.set()

    service.rig.script.do("scale read", hang)
    service.start()
    service.wait_for("scale read")
    assert service.client.post("/api/v1/stop").status_code == 200
    assert not ended.is_set(), "the answer did not wait for the worker"
    service.rig.released.set()


def test_an_axis_that_did_not_confirm_is_named(service: Service) -> None:
    service.wait_for("scale read")
    service.rig.script.fail("axis 2 quick_stop", LinkLost("axis 2: nothing answers"))
    answer = service.client.post("/api/v1/stop")
    said = {"axis 1": None, "axis 2": "axis 2: nothing answers"}
    assert (answer.status_code, answer.json()) == (502, {"axes": said, "confirmed": False})


def test_a_locked_database_changes_nothing_about_the_answer(service: Service, tmp_path: Path) -> None:
    """The answer is that of the drives; the record follows when the database can be written again."""
    service.wait_for("scale read")
    with closing(sqlite3.connect(tmp_path / "station.db", isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        answer = service.client.post("/api/v1/stop", headers={"X-Operator": "ada"})
        assert (answer.status_code, answer.json()["confirmed"]) == (200, True)
        other.execute("ROLLBACK")
        service.runtime.orchestrator.shutdown()
        (recorded,) = other.execute("SELECT count(*) FROM events WHERE kind = 'stop'").fetchone()
    assert recorded == 1


def test_a_stop_that_does_not_come_back_says_so(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stop_route, "STOP_TIMEOUT_S", 0.1)
    monkeypatch.setattr(service.runtime.orchestrator, "stop", lambda who: service.rig.released.wait())
    answer = service.client.post("/api/v1/stop")
    said = dict.fromkeys(("axis 1", "axis 2"), "no answer within 0.1 s")
    assert (answer.status_code, answer.json()) == (502, {"axes": said, "confirmed": False})
    service.rig.released.set()


def test_a_stop_that_fails_is_not_called_done(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(who: str) -> None:
        raise OSError("no bus")

    monkeypatch.setattr(service.runtime.orchestrator, "stop", fails)
    answer = service.client.post("/api/v1/stop")
    assert (answer.status_code, answer.json()["confirmed"]) == (502, False)
