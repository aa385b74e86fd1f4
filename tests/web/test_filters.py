"""What a MES asks for is what it gets, and nothing else."""

from __future__ import annotations

import csv
import io
import sqlite3
from datetime import timedelta
from typing import Any

import pytest

from station.records import State
from station.store import Filters
from station.store.filters import where
from tests.station.asking import asked
from tests.web.conftest import BODY, Service
from web.routes import run_table

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


def test_runs_are_found_by_how_their_serial_begins_counted_and_written_as_a_table(service: Service) -> None:
    store = service.runtime.store
    runs = {
        serial: store.create(asked(serial, "paper", work_order="WO-7"), store.robot_or_nominal(serial))
        for serial in ("FB-10", "fb-11", "FB-2", "XFB-1", "Fb_1")
    }
    found = [runs["fb-11"], runs["FB-10"]]
    assert ids(service, search="Fb-1") == found
    assert ids(service, search="fb-1", order="oldest") == found[::-1]
    assert ids(service, search="fb-1", order="oldest", cursor=found[1]) == [found[0]]
    assert ids(service, search="%") == []
    by_serial = [runs[serial] for serial in ("FB-10", "fb-11", "FB-2", "Fb_1", "XFB-1")]
    assert ids(service, order="serial") == by_serial
    assert ids(service, order="serial_down") == by_serial[::-1]
    assert ids(service, order="serial", cursor=by_serial[1], limit=2) == by_serial[2:4]
    assert ids(service, order="serial_down", cursor=by_serial[1], search="fb") == by_serial[:1]
    count = service.client.get(f"{RUNS}/count", params={"search": "fb-", "work_order": "WO-7"})
    assert count.json() == {"count": 3, "more": False}
    answer = service.client.get(f"{RUNS}.csv", params={"search": "fb-1"})
    table = list(csv.DictReader(io.StringIO(answer.text)))
    assert [row["robot_serial"] for row in table] == ["fb-11", "FB-10"]
    assert {row["work_order"] for row in table} == {"WO-7"}


@pytest.mark.parametrize(
    ("query", "count"),
    [
        ({}, 5),
        ({"search": "FB", "state": "queued"}, 4),
        ({"search": "fb", "plan": "rapid"}, 0),
        ({"search": "fb", "until": "2001-01-01T00:00:00Z"}, 0),
        ({"since": "2001-01-01T00:00:00Z", "until": "2999-01-01T00:00:00Z"}, 5),
        ({"plan": "paper", "until": "2001-01-01T00:00:00Z"}, 0),
    ],
)
def test_a_list_is_counted_by_its_filters(service: Service, query: dict[str, str], count: int) -> None:
    store = service.runtime.store
    for serial in ("FB-10", "fb-11", "FB-2", "Fb_1", "XFB-1"):
        store.create(asked(serial, "paper"), store.robot_or_nominal(serial))
    answer = service.client.get(f"{RUNS}/count", params=query)
    assert answer.json() == {"count": count, "more": False}
    assert len(ids(service, **query)) == count


def test_many_runs_are_not_counted_to_the_last(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.store.store.MOST_COUNTED", 2)
    store = service.runtime.store
    for _ in range(3):
        store.create(asked("R1", "paper"), store.robot_or_nominal("R1"))
    counts = f"{RUNS}/count"
    assert service.client.get(counts).json() == {"count": 2, "more": True}
    store.finish(1, State.FAILED)
    assert service.client.get(counts, params={"state": "queued"}).json() == {"count": 2, "more": False}


def test_a_long_table_comes_whole_and_with_one_header(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_table, "PAGE", 2)
    store = service.runtime.store
    made = [store.create(asked("R1", "paper"), store.robot_or_nominal("R1")) for _ in range(5)]
    table = csv.DictReader(io.StringIO(service.client.get(f"{RUNS}.csv").text))
    assert [int(row["id"]) for row in table] == made[::-1]


def test_a_search_chooses_the_index_where_it_finds_few(service: Service) -> None:
    """Of many matches the newest are soon met going through all; the planner cannot know which it is."""
    plans = []
    for few_found in (True, False):
        conditions, values = Filters(search="fb").conditions(lambda _: "", few_found=few_found)
        sql = f"EXPLAIN QUERY PLAN SELECT id FROM calibrations{where(conditions)} ORDER BY id DESC LIMIT 21"
        db = sqlite3.connect(service.runtime.store.path)
        plans.append(" ".join(row[3] for row in db.execute(sql, values)))
        db.close()
    assert "calibrations_serial_nocase" in plans[0]
    assert plans[1] == "SCAN calibrations"


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
