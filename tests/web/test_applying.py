"""Applying and rolling back over REST."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from station.service.orchestrator import Orchestrator
from station.service.runtime import Runtime
from station.store.store import Store
from tests.station.asking import kinds_with, start_procedure
from tests.station.conftest import SETTINGS
from tests.station.fakes import make_rig
from tests.station.run_kinds.test_apply import OFFSETS, ROBOT
from tests.web.conftest import LIMIT_S, Service
from web.app import create_app

LIST = "/api/v1/calibrations"
ADA = {"operator": "ada"}


@pytest.fixture
def service(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Service]:
    """As the usual one, with a robot that has zero offsets and the real procedures."""
    rig = make_rig()
    for axis, offset in zip(rig.axes, OFFSETS, strict=True):
        axis.offset_deg = offset
    with ExitStack() as opened:
        store = Store(tmp_path / "station.db")
        opened.callback(store.close)
        store.save_robot(ROBOT)
        orchestrator = Orchestrator(rig.devices, store, SETTINGS, kinds_with(start_procedure))
        opened.callback(orchestrator.shutdown)
        runtime = Runtime(SETTINGS, tmp_path, store, orchestrator, ExitStack())
        client = TestClient(create_app(runtime), base_url="http://station", raise_server_exceptions=False)
        yield Service(opened.enter_context(client), runtime, rig, monkeypatch)


def ended(service: Service, answer: Any) -> dict[str, Any]:
    assert answer.status_code == 202, answer.text
    service.runtime.orchestrator.wait(answer.json()["id"], LIMIT_S)
    found: dict[str, Any] = service.client.get(answer.headers["location"]).json()
    return found


def test_apply_and_rollback_are_runs_of_their_own(service: Service) -> None:
    run = service.complete(robot_serial="R1", plan="rapid")
    before = service.client.get(f"{LIST}/{run}").json()["application"]
    assert (before["state"], before["runs"], before["apply_refused"]) == ("unwritten", [], None)
    assert "nothing to roll back" in before["rollback_refused"]
    headers = {"Idempotency-Key": "k"}
    applied = ended(service, service.client.post(f"{LIST}/{run}/apply", json=ADA, headers=headers))
    assert (applied["plan"], applied["of"], applied["verdict"]) == ("apply", run, "pass")
    assert applied["application"] is None
    again = service.client.post(f"{LIST}/{run}/apply", json=ADA, headers=headers)
    assert again.json()["id"] == applied["id"]
    state = service.client.get(f"{LIST}/{run}").json()["application"]
    assert (state["state"], state["verified"]) == ("applied", True)
    assert [joint["new_offset_deg"] for joint in state["joints"]] == pytest.approx([0, 0], abs=1e-6)
    assert state["runs"][0]["operator"] == "ada"
    back = ended(service, service.client.post(f"{LIST}/{run}/rollback", json=ADA))
    assert (back["plan"], back["of"], back["verdict"]) == ("rollback", run, "pass")
    assert service.client.post(f"{LIST}/{run}/rollback", json=ADA).json()["id"] == back["id"]
    assert service.client.get(f"{LIST}/{run}").json()["application"]["state"] == "rolled back"


@pytest.mark.parametrize("what", ["apply", "rollback"])
def test_a_refusal_is_a_problem_that_says_why(service: Service, what: str) -> None:
    run = service.hold()
    service.client.post(f"{LIST}/{run}/abort")
    service.runtime.orchestrator.wait(run, LIMIT_S)
    answer = service.client.post(f"{LIST}/{run}/{what}", json=ADA)
    assert (answer.status_code, answer.json()["type"]) == (409, "urn:station:problem:not-applicable")
    assert answer.json()["detail"] == f"Run {run} has not passed; only the offsets of a pass are written."
    assert service.client.post(f"{LIST}/99/{what}", json=ADA).status_code == 404
    assert service.client.post(f"{LIST}/{run}/{what}", json={}).json()["field"] == "operator"


def test_the_run_under_way_says_what_it_is_about(service: Service) -> None:
    run = service.complete(robot_serial="R1", plan="rapid")
    service.rig.axes[0].stuck = True
    applying = service.client.post(f"{LIST}/{run}/apply", json=ADA).json()
    assert service.client.get("/api/v1/station").json()["run"]["of"] == run
    assert service.client.post(f"{LIST}/{run}/apply", json=ADA).json()["type"].endswith("busy")
    assert service.client.post("/api/v1/stop").status_code == 200
    assert service.runtime.orchestrator.wait(applying["id"], LIMIT_S) == "aborted"
    assert service.client.get(f"{LIST}/{run}").json()["application"]["state"] == "unwritten"


def test_the_error_map_of_a_run_and_of_its_application(service: Service) -> None:
    run = service.complete(robot_serial="R1", plan="rapid")
    answer = service.client.get(f"{LIST}/{run}/error-map")
    found = answer.json()
    assert answer.status_code == 200, answer.text
    assert found["bound_95_mm"] == service.client.get(f"{LIST}/{run}").json()["accuracy"]["bound_95_mm"]
    assert max(map(max, found["after_95_mm"])) < min(map(min, found["before_mm"]))
    assert len(found["fresh"]) == 8
    known = {"If-None-Match": answer.headers["etag"]}
    assert service.client.get(f"{LIST}/{run}/error-map", headers=known).status_code == 304
    applied = ended(service, service.client.post(f"{LIST}/{run}/apply", json=ADA))["id"]
    held = service.client.get(f"{LIST}/{applied}/error-map").json()
    assert held["bound_95_mm"] == pytest.approx(found["bound_95_mm"], rel=0.02)
    assert len(held["fresh"]) == 8
    assert max(abs(reading["residual_mm"]) for reading in held["fresh"]) < 0.1


def test_without_zero_offsets_there_is_no_error_map(service: Service) -> None:
    run = service.complete(robot_serial="R1", plan="rapid")
    ended(service, service.client.post(f"{LIST}/{run}/apply", json=ADA))
    back = ended(service, service.client.post(f"{LIST}/{run}/rollback", json=ADA))["id"]
    answer = service.client.get(f"{LIST}/{back}/error-map")
    assert answer.status_code == 409
    assert answer.json()["detail"] == f"Run {back} has no error map: it identified no zero offsets."
    assert service.client.get(f"{LIST}/99/error-map").status_code == 404
