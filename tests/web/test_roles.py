"""Every route and every role: exactly what the table of the reference says, and nobody without a key."""

from __future__ import annotations

import re

import pytest

from station.people import ALLOWED, ROLES, Permission
from station.records import Actor
from station.reference import RouteNeed, route_needs
from tests.web.conftest import LIMIT_S, Service

NEEDS = sorted(route_needs(), key=lambda need: (need.path, need.method))
HTTP = [need for need in NEEDS if need.method != "WebSocket"]
KEPT_OUT = (401, 403)


def name_of(need: RouteNeed) -> str:
    return f"{need.method} {need.path}"


@pytest.mark.parametrize("need", HTTP, ids=name_of)
def test_every_cell_of_the_table(closed: Service, need: RouteNeed) -> None:
    """A refusal names the role; whoever may pass gets past the guard, whatever the route then says."""
    path = re.sub(r"{\w*id}", "999", need.path).replace("{serial}", "FB-1").replace("{name}", "paper")
    assert "{" not in path
    for role in ROLES:
        answer = closed.client.request(need.method, path, headers=closed.key(role))
        allowed = role in ALLOWED[need.permission]
        assert (answer.status_code not in KEPT_OUT) == allowed, (role, answer.text)
        if not allowed:
            problem = answer.json()
            assert problem["type"] == "urn:station:problem:forbidden"
            assert f"has the role {role}" in problem["detail"]
    answer = closed.client.request(need.method, path)
    assert (answer.status_code == 401) == (need.permission is not Permission.ENTER)


def test_the_table_has_every_route_of_the_interface(closed: Service) -> None:
    described = closed.client.get("/openapi.json").json()["paths"]
    known = {
        (method.upper(), path)
        for path, item in described.items()
        for method in item
        if path not in ("/healthz", "/readyz")
    }
    assert {(need.method, need.path) for need in HTTP} == known


def test_a_mes_ends_only_what_it_started(closed: Service) -> None:
    mine, other = closed.key("mes", "line 4"), closed.key("mes", "line 5")
    closed.patch.setattr("station.motion.positioner._ARRIVAL_MARGIN_S", 600.0)
    closed.rig.axes[0].stuck = True
    body = {"robot_serial": "FB-1", "plan": "paper", "operator": "ada"}
    run = closed.client.post("/api/v1/calibrations", json=body, headers=mine).json()["id"]
    closed.wait_for("axis 1 move_to")
    refused = closed.client.post(f"/api/v1/calibrations/{run}/abort", headers=other)
    assert refused.status_code == 403 and "only runs that it started" in refused.json()["detail"]
    assert closed.client.post(f"/api/v1/calibrations/{run}/abort", headers=mine).status_code == 202
    assert closed.runtime.orchestrator.wait(run, LIMIT_S) == "aborted"


def test_roles_of_the_contract() -> None:
    may = {role: {p for p in Permission if role in ALLOWED[p]} for role in ROLES}
    reads = {Permission.ENTER, Permission.READ, Permission.STOP}
    assert may["viewer"] == reads
    assert may["mes"] == reads | {Permission.START, Permission.ABORT}
    assert may["operator"] == may["mes"] | {Permission.OPERATE}
    assert may["engineer"] == may["operator"] | {Permission.MAINTAIN}
    assert may["administrator"] == set(Permission)


def test_who_started_is_on_record(closed: Service) -> None:
    body = {"robot_serial": "FB-1", "plan": "paper", "operator": "ada"}
    run = closed.client.post("/api/v1/calibrations", json=body, headers=closed.key("mes", "line 4")).json()[
        "id"
    ]
    assert closed.runtime.store.started_by(run) == Actor(name="line 4", via="key")
