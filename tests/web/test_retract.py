"""The way back over REST."""

from __future__ import annotations

from tests.web.conftest import LIMIT_S, Service


def test_retract_is_a_run_of_its_own(service: Service) -> None:
    service.rig.axes[0].theta_deg, service.rig.axes[1].theta_deg = -45.0, 140.0
    answer = service.client.post("/api/v1/retract", json={"operator": "ada"})
    assert answer.status_code == 202
    run = answer.json()
    assert answer.headers["location"] == f"/api/v1/calibrations/{run['id']}"
    assert (run["kind"], run["operator"]) == ("retract", "ada")
    assert service.runtime.orchestrator.wait(run["id"], LIMIT_S) == "succeeded"
    ended = service.client.get(answer.headers["location"]).json()
    assert (ended["verdict"], ended["outcome"]) == (None, "good")
    assert service.client.get("/api/v1/station").json()["retract"]["needed"] is False


def test_it_is_refused_while_another_run_holds_the_rig(service: Service) -> None:
    run = service.hold()
    answer = service.client.post("/api/v1/retract", json={"operator": "ada"})
    assert (answer.status_code, answer.json()["calibration_id"]) == (409, run)


def test_it_needs_an_operator(service: Service) -> None:
    assert service.client.post("/api/v1/retract", json={}).status_code == 422
