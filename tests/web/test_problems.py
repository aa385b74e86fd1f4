"""Every error is a problem document and tells nothing about the inside."""

from __future__ import annotations

from typing import Any

import pytest

from station.store.store import Store
from tests.web.conftest import BODY, Service

RUNS = "/api/v1/calibrations"


def problem_of(answer: Any, status: int) -> Any:
    assert answer.status_code == status
    assert answer.headers["content-type"] == "application/problem+json"
    document = answer.json()
    assert document["status"] == status
    assert document["type"] and document["title"] and document["detail"]
    return document


@pytest.mark.parametrize("path", ["/nothing", "/api/v1/nothing", f"{RUNS}/1", "/assets/none.js"])
def test_what_is_not_there(service: Service, path: str) -> None:
    problem_of(service.client.get(path), 404)


def test_a_body_that_is_no_json(service: Service) -> None:
    headers = {"Content-Type": "application/json"}
    problem_of(service.client.post(RUNS, content=b"{", headers=headers), 422)


def test_each_field_at_fault_is_listed(service: Service) -> None:
    document = problem_of(service.client.post(RUNS, json={"plan": "paper"}), 422)
    assert [error["field"] for error in document["errors"]] == ["robot_serial", "operator"]


def test_a_failure_inside_shows_no_traceback(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("secret place")

    monkeypatch.setattr(Store, "calibrations", broken)
    answer = service.client.get(RUNS)
    problem_of(answer, 500)
    assert "secret" not in answer.text and "Traceback" not in answer.text


@pytest.mark.parametrize("path", [RUNS, "/api/v1/stop"])
def test_another_sites_page_may_not_command(service: Service, path: str) -> None:
    service.wait_for("scale read")
    answer = service.client.post(path, json=BODY, headers={"Origin": "http://elsewhere"})
    problem_of(answer, 403)
    assert service.client.get(RUNS).json()["items"] == []
    assert service.client.post(path, json=BODY, headers={"Origin": "http://station"}).is_success
