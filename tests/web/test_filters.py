"""What a MES asks for is what it gets, and nothing else."""

from __future__ import annotations

from datetime import timedelta
from typing import Any

import pytest

from station.records import State
from tests.station.asking import asked
from tests.web.conftest import BODY, Service

RUNS = "/api/v1/calibrations"


def ids(service: Service, **query: Any) -> list[int]:
    answer = service.client.get(RUNS, params=query)
    assert answer.status_code == 200, answer.text
    return [item["id"] for item in answer.json()["items"]]


def test_runs_by_work_order_plan_and_end(service: Service) -> None:
    store = service.runtime.store
    robot = store.robot_or_nominal("R1")
    first = store.create(asked("R1", "paper", work_order="WO-7"), robot)
    second = store.create(asked("R1", "rapid", work_order="WO-8"), robot)
    third = store.create(asked("R2", "apply", work_order="WO-7", of=first), robot)
    for run in (first, second):
        store.finish(run, State.ABORTED)
    assert ids(service, work_order="WO-7") == [third, first]
    assert ids(service, work_order="WO-7", plan="paper") == [first]
    assert ids(service, plan="apply") == [third]
    assert ids(service, work_order="WO-9") == []
    ended = store.summary(second).ended_at
    assert ended is not None
    assert second in ids(service, ended_since=ended.isoformat())
    assert ids(service, ended_since=(ended + timedelta(seconds=1)).isoformat()) == []
    assert third not in ids(service, ended_since="2000-01-01T00:00:00Z"), "it has not ended"


@pytest.mark.parametrize(
    ("path", "query", "said"),
    [
        (RUNS, {"workorder": "WO-7"}, "workorder is no query parameter of this address; there is cursor, "),
        (f"{RUNS}/1", {"full": "1"}, "full is no query parameter of this address; there is none here."),
        ("/api/v1/station", {"x": ""}, "x is no query parameter"),
        ("/api/v1/robots/R1", {"x": ""}, "x is no query parameter"),
    ],
)
def test_a_parameter_with_a_slip_in_its_name_is_refused(
    service: Service, path: str, query: dict[str, str], said: str
) -> None:
    answer = service.client.get(path, params=query)
    assert (answer.status_code, answer.json()["field"]) == (422, next(iter(query)))
    assert answer.json()["detail"].startswith(said)


def test_nothing_starts_with_a_parameter_that_is_not_known(service: Service) -> None:
    assert service.client.post(f"{RUNS}?dry_run=1", json=BODY).status_code == 422
    assert ids(service) == []


def test_metadata_in_another_order_is_the_same_request(service: Service) -> None:
    first = service.start(key="k", metadata={"a": 1, "b": 2})
    again = service.start(key="k", metadata={"b": 2, "a": 1})
    assert (again.status_code, again.json()["id"]) == (202, first.json()["id"])
    assert service.start(key="k", metadata={"a": 1, "b": 3}).status_code == 409


@pytest.mark.parametrize("name", ["since", "until", "ended_since"])
@pytest.mark.parametrize("value", ["2026", "0.5", "nan", "-1"])
def test_a_number_is_no_time(service: Service, name: str, value: str) -> None:
    answer = service.client.get("/api/v1/calibrations", params={name: value})
    assert (answer.status_code, answer.json()["field"]) == (422, name)
    assert "date or time" in answer.json()["detail"]
