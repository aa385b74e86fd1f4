"""Starting, finding, listing and aborting runs over REST."""

from __future__ import annotations

from typing import Any

import pytest

from tests.web.conftest import LIMIT_S, Service

LIST = "/api/v1/calibrations"


def test_a_start_is_accepted_and_says_where_the_run_is(service: Service) -> None:
    answer = service.start(work_order="WO-7", metadata={"shift": "late"})
    assert answer.status_code == 202
    place = answer.headers["location"]
    service.runtime.orchestrator.wait(answer.json()["id"], LIMIT_S)
    run = service.client.get(place).json()
    assert (run["state"], run["verdict"], run["reason"]) == (
        "succeeded",
        "pass",
        "Converged in 2 passes; the compensation accuracy is 0.0100°.",
    )
    assert run["zero_offsets"] == [
        {"joint": 1, "value_deg": 0.5, "sd_deg": 0.1},
        {"joint": 2, "value_deg": -0.5, "sd_deg": 0.1},
    ]
    assert (run["work_order"], run["metadata"]) == ("WO-7", {"shift": "late"})
    assert run["iterations"][1] == {
        "pass": 2,
        "mu_deg": 0.01,
        "dtheta1_deg": None,
        "dtheta2_deg": None,
        "total1_deg": None,
        "total2_deg": None,
        "condition": None,
    }
    assert run["zero_offset_tolerance_deg"] == 3.0
    assert run["after"]["reading_rms_mm"] == 0.01


def test_the_same_key_and_body_twice_is_one_run(service: Service) -> None:
    first, second = service.start(key="k1"), service.start(key="k1")
    assert (first.status_code, second.status_code) == (202, 202)
    assert first.json()["id"] == second.json()["id"]
    assert first.headers["location"] == second.headers["location"]
    service.runtime.orchestrator.wait(first.json()["id"], LIMIT_S)
    assert service.start(key="k1").json()["state"] == "succeeded"
    assert len(service.client.get(LIST).json()["items"]) == 1


def test_the_same_key_with_another_body_is_refused(service: Service) -> None:
    run = service.start(key="k1").json()["id"]
    answer = service.start(key="k1", operator="bob")
    assert answer.status_code == 409
    problem = answer.json()
    assert (problem["type"], problem["field"]) == ("urn:station:problem:key-reused", "Idempotency-Key")
    assert problem["calibration_id"] == run


def test_a_second_run_while_one_holds_the_rig_is_refused(service: Service) -> None:
    run = service.hold()
    answer = service.start(robot_serial="FB-2")
    assert answer.status_code == 409
    assert (answer.json()["type"], answer.json()["calibration_id"]) == ("urn:station:problem:busy", run)
    assert len(service.client.get(LIST).json()["items"]) == 1


def test_abort_may_be_called_twice(service: Service) -> None:
    run = service.hold()
    for _ in range(2):
        assert service.client.post(f"{LIST}/{run}/abort").status_code == 202
    assert service.runtime.orchestrator.wait(run, LIMIT_S) == "aborted"
    assert service.client.post(f"{LIST}/{run}/abort").json()["state"] == "aborted"
    assert service.client.get(f"{LIST}/{run}").json()["verdict"] is None


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"robot_serial": " "}, "robot_serial"),
        ({"robot_serial": "FB 1"}, "robot_serial"),
        ({"operator": ""}, "operator"),
        ({"plan": "quick"}, "plan"),
        ({"speed": 5}, "speed"),
    ],
)
def test_a_wrong_body_names_the_field(service: Service, changes: dict[str, Any], field: str) -> None:
    answer = service.start(**changes)
    assert (answer.status_code, answer.json()["field"]) == (422, field)


def test_every_plan_that_is_offered_is_accepted(service: Service) -> None:
    plans = service.client.get("/api/v1/station").json()["station"]["plans"]
    assert plans == [
        *("paper", "rapid", "full", "diagnostic", "adaptive", "check"),
        *("reference", "two_mounts", "gauge_study"),
    ]
    for plan in plans:
        run = service.complete(plan=plan)
        assert service.client.get(f"{LIST}/{run}").json()["plan"] == plan


def test_a_scanned_serial_loses_its_blanks(service: Service) -> None:
    assert service.start(robot_serial=" FB-1\t").json()["robot_serial"] == "FB-1"


def test_pages_follow_each_other_without_gap_or_repeat(service: Service) -> None:
    runs = [service.complete() for _ in range(5)]
    seen: list[int] = []
    cursor: int | None = None
    while True:
        page = service.client.get(LIST, params={"limit": 2, **({"cursor": cursor} if cursor else {})}).json()
        seen += [run["id"] for run in page["items"]]
        if (cursor := page["next"]) is None:
            break
    assert seen == runs[::-1]


def test_the_list_is_filtered(service: Service) -> None:
    passed = service.complete()
    other = service.complete(robot_serial="FB-2")
    aborted = service.hold()
    service.client.post(f"{LIST}/{aborted}/abort")
    service.runtime.orchestrator.wait(aborted, LIMIT_S)

    def listed(**filters: str) -> list[int]:
        return [run["id"] for run in service.client.get(LIST, params=filters).json()["items"]]

    assert listed(robot_serial="FB-2") == [other]
    assert listed(state="aborted") == [aborted]
    assert listed(verdict="pass", robot_serial="FB-1") == [passed]
    created = service.client.get(f"{LIST}/{other}").json()["created_at"]
    assert listed(since=created) == [aborted, other]
    assert listed(until=created) == [passed]
    assert listed(since="2100-01-01") == []


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("limit", "0"),
        ("limit", "501"),
        ("cursor", "x"),
        ("cursor", str(2**63)),
        ("state", "odd"),
        ("since", "noon"),
    ],
)
def test_a_wrong_filter_names_the_field(service: Service, name: str, value: str) -> None:
    answer = service.client.get(LIST, params={name: value})
    assert (answer.status_code, answer.json()["field"]) == (422, name)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("robot_serial", ".."),
        ("robot_serial", "\uff26\uff22-1"),
        ("robot_serial", "F\u0412-1"),
        ("operator", "a\x00b"),
        ("operator", "a\x1b[2Jb"),
        ("work_order", "a\nb"),
    ],
)
def test_what_cannot_be_told_apart_or_printed_is_refused(service: Service, field: str, value: str) -> None:
    answer = service.start(**{field: value})
    assert (answer.status_code, answer.json()["field"]) == (422, field)
    assert service.client.get("/api/v1/calibrations").json()["items"] == []
