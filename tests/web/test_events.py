"""Events for those who pull, deliveries for those who look, and the audit as JSON and CSV."""

from __future__ import annotations

import csv
import io

from station.records import Actor
from tests.web.conftest import Service

ROOT = Actor(name="root", via="terminal")


def test_events_follow_each_other_without_gaps(service: Service) -> None:
    run = service.complete()
    first = service.client.get("/api/v1/events?limit=1").json()
    assert [e["n"] for e in first["items"]] == [1] and first["next"] == 1
    rest = service.client.get("/api/v1/events?after=1").json()
    assert [(e["n"], e["type"]) for e in rest["items"]] == [(2, "run.ended")] and rest["next"] is None
    summary = service.client.get(f"/api/v1/calibrations/{run}").json()
    data = rest["items"][0]["data"]
    for key in ("uid", "id", "state", "verdict", "outcome", "work_order"):
        assert data[key] == summary[key]


def test_a_delivery_is_shown_and_sent_again(service: Service) -> None:
    store = service.runtime.store
    store.enqueue("webhook http://localhost/", ["alarm"])
    store.announce("alarm", {"text": "a"})
    store.enqueue("webhook http://localhost/", ["alarm"])
    (item,) = service.client.get("/api/v1/deliveries?state=waiting").json()["items"]
    store.settle(item["id"], "refused", "410 Gone")
    assert service.client.get("/api/v1/deliveries?state=waiting").json() == {"items": [], "next": None}
    again = service.client.post(f"/api/v1/deliveries/{item['id']}/resend")
    assert (again.status_code, again.json()["state"]) == (202, "waiting")
    assert service.client.post("/api/v1/deliveries/99/resend").status_code == 404
    assert service.client.get("/api/v1/deliveries?state=lost").status_code == 422


def test_the_audit_says_who_did_what(closed: Service) -> None:
    root = closed.key("administrator", "root")
    mes = closed.key("mes", "=line 4")
    body = {"robot_serial": "FB-1", "plan": "paper", "operator": "ada"}
    run = closed.client.post("/api/v1/calibrations", json=body, headers=mes).json()["id"]
    closed.client.post(f"/api/v1/calibrations/{run}/abort", headers=root)
    closed.client.post("/api/v1/stop", headers=mes)
    closed.client.delete("/api/v1/robots/FB-1/memory", headers=root)
    answer = closed.client.get("/api/v1/audit", headers=root).json()
    deeds = [(e["action"], e["subject"], e["who"], e["role"]) for e in reversed(answer["items"])][2:]
    assert deeds == [
        ("run.started", f"run {run}", "=line 4", "mes"),
        ("run.aborted", f"run {run}", "root", "administrator"),
        ("station.stopped", "both axes", "=line 4", "mes"),
        ("memory.cleared", "robot FB-1", "root", "administrator"),
    ]
    page = closed.client.get("/api/v1/audit?limit=2", headers=root).json()
    after = closed.client.get(f"/api/v1/audit?limit=2&cursor={page['next']}", headers=root).json()
    assert page["items"] + after["items"] == answer["items"][:4]
    table = list(csv.DictReader(io.StringIO(closed.client.get("/api/v1/audit.csv", headers=root).text)))
    assert len(table) == len(answer["items"]) and table[1]["who"] == "'=line 4"


def test_the_audit_is_searched_over_all_pages(closed: Service) -> None:
    root = closed.key("administrator", "root")
    store = closed.runtime.store
    store.record(
        Actor(name="Ada", via="user", role="engineer"), "setting.changed", "limits", after={"value": "20"}
    )
    for number in range(30):
        store.record(ROOT, "run.started", f"run {number}")

    def found(text: str, **more: int) -> list[str]:
        answer = closed.client.get("/api/v1/audit", params={"contains": text, **more}, headers=root)
        return [entry["subject"] for entry in answer.json()["items"]]

    assert found("ADA", limit=5) == found("value 20") == found("engineer") == ["limits"], "far behind"
    assert found("run.started", limit=2) == ["run 29", "run 28"]
    assert found("run 1", limit=500) == [f"run {n}" for n in (*range(19, 9, -1), 1)]
    assert found("%") == found("nobody") == []
    rows = closed.client.get("/api/v1/audit.csv", params={"contains": "limits"}, headers=root).text
    assert len(rows.splitlines()) == 2
