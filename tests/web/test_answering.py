"""Runs that ask, and failed checks that lock, over REST."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from station.five_bar import Robot
from station.records import Ask, MeasurementSequence, PlanName, Procedure, State, because
from station.service.orchestrator import Orchestrator
from tests.station.asking import asked, kinds_with
from tests.station.conftest import SETTINGS
from tests.station.fakes import STOPS, result_of
from tests.waiting import soon
from tests.web.conftest import LIMIT_S, Service


def asks(plan: PlanName, robot: Robot) -> Procedure:
    readings = yield MeasurementSequence("Measuring", 1, STOPS[:1])
    yield Ask("Reading the level", 1, "Read the level.", "number", "deg", low=-1.0, high=1.0)
    return result_of(readings)


@pytest.fixture
def asking(service: Service) -> Iterator[Service]:
    """The same service with a procedure that asks."""
    service.runtime.orchestrator.shutdown()
    orchestrator = Orchestrator(service.rig.devices, service.runtime.store, SETTINGS, kinds_with(asks))
    service.runtime.orchestrator = orchestrator
    yield service
    orchestrator.shutdown()


def waiting(service: Service, run: int) -> dict[str, Any]:
    def asked() -> dict[str, Any] | None:
        body: dict[str, Any] = service.client.get(f"/api/v1/calibrations/{run}").json()
        return body if body["state"] == "waiting" and body["prompt"] else None

    return soon(asked)


def test_a_prompt_is_shown_and_answered(asking: Service) -> None:
    run = asking.start().json()["id"]
    prompt = waiting(asking, run)["prompt"]
    assert {key: prompt[key] for key in ("text", "kind", "unit")} == {
        "text": "Read the level.",
        "kind": "number",
        "unit": "deg",
    }
    assert asking.client.get("/api/v1/station").json()["run"]["prompt"] == prompt
    address = f"/api/v1/calibrations/{run}/answer"
    for body, status in (
        ({"prompt": "another", "value": 0.1}, 409),
        ({"prompt": prompt["id"]}, 422),
        ({"prompt": prompt["id"], "value": 5.0}, 422),
        ({"prompt": prompt["id"], "value": "much"}, 422),
        ({"value": 0.1}, 422),
    ):
        assert asking.client.post(address, json=body).status_code == status, body
    assert asking.client.post("/api/v1/calibrations/99/answer", json={"prompt": "x"}).status_code == 404
    assert asking.client.post(address, json={"prompt": prompt["id"], "value": 0.1}).status_code == 200
    assert asking.runtime.orchestrator.wait(run, LIMIT_S) is State.SUCCEEDED
    assert asking.client.post(address, json={"prompt": prompt["id"], "value": 0.1}).status_code == 409


def checked(service: Service, verdict: str) -> int:
    """A check that ended so."""
    store = service.runtime.store
    run = store.create(asked("FB-1", "check"), Robot.default("FB-1"))
    reason = because("still_calibrated", smallest_deg=0.01) if verdict == "pass" else because("not_finite")
    store.finish(run, State.SUCCEEDED, result_of([], verdict).model_copy(update={"reason": reason}))
    return run


def holds(service: Service) -> dict[str, Any]:
    """As the station says after its next run."""
    service.complete(robot_serial="FB-1", plan="diagnostic")
    body: dict[str, Any] = service.client.get("/api/v1/station").json()["calibration"]
    return body


def test_a_failed_check_locks_until_an_engineer_clears_it(service: Service) -> None:
    passed = service.complete()
    assert holds(service)["locked"] is False
    failed = checked(service, "fail")
    body = holds(service)
    assert (body["robot_serial"], body["locked"], body["check"]) == ("FB-1", True, failed)
    apply = f"/api/v1/calibrations/{passed}/apply"
    refused = service.client.post(apply, json={"operator": "ada"})
    assert refused.status_code == 409
    assert "Locked" in refused.json()["detail"]
    assert checked(service, "pass") > failed
    assert holds(service)["locked"] is True
    clear = "/api/v1/robots/FB-1/clear-check"
    assert service.client.post(clear, json={"operator": "eve"}).status_code == 422
    cleared = service.client.post(clear, json={"operator": "eve", "reason": "the level was dirty"})
    assert (cleared.status_code, cleared.json()["locked"]) == (200, False)
    assert service.client.get("/api/v1/station").json()["calibration"]["locked"] is False
    assert service.client.post(clear, json={"operator": "eve", "reason": "again"}).status_code == 409
    events = [event.data for event in service.runtime.store.events(failed) if event.kind == "check_cleared"]
    assert events == [{"by": "eve", "reason": "the level was dirty"}]


def test_a_passed_calibration_clears_it(service: Service) -> None:
    service.complete()
    checked(service, "fail")
    assert holds(service)["locked"] is True
    service.complete()
    assert holds(service)["locked"] is False
