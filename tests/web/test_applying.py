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


KRL = "DECL E6AXIS XP1={A1 10.5,A2 170.25,A3 0.0} ; pick"


def test_taught_positions_move_with_the_zeros_of_the_drives(service: Service) -> None:
    """As a list, a file, and a program, which is returned with other angles; and back."""
    run = service.complete(robot_serial="R1", plan="rapid")
    ended(service, service.client.post(f"{LIST}/{run}/apply", json=ADA))
    address = f"{LIST}/{run}/translate"
    listed = [{"position": "XP1", "theta1_deg": 10.5, "theta2_deg": 170.25}]
    table = "theta2_deg;theta1_deg;position\n170,25;10,5;XP1\n"
    answers = [
        service.client.post(address, json=body).json()
        for body in ({"positions": listed}, {"text": table}, {"text": KRL})
    ]
    (new,) = answers[0]["items"]
    assert [new["theta1_deg"] - 10.5, new["theta2_deg"] - 170.25] == pytest.approx(OFFSETS, abs=0.01)
    assert all(answer["items"] == [new] for answer in answers)
    angles = f"A1 {new['theta1_deg']:.6f},A2 {new['theta2_deg']:.6f},A3 0.0"
    assert [answer["program"] for answer in answers] == [
        None, None, f"DECL E6AXIS XP1={{{angles}}} ; pick",
    ]  # fmt: skip
    again = service.client.post(address, json={"text": answers[2]["program"], "back": True}).json()
    assert [again["items"][0][name] for name in ("theta1_deg", "theta2_deg")] == pytest.approx([10.5, 170.25])


@pytest.mark.parametrize("body", [{}, {"positions": [], "text": "x"}, {"text": "position,theta1_deg\n"}])
def test_taught_positions_that_cannot_be_read_are_refused(service: Service, body: dict[str, Any]) -> None:
    run = service.complete(robot_serial="R1", plan="rapid")
    ended(service, service.client.post(f"{LIST}/{run}/apply", json=ADA))
    assert service.client.post(f"{LIST}/{run}/translate", json=body).status_code == 422


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
