"""The training desk over REST, with the emulated machine's process and fake devices."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from station.motion import EmulatedRig
from station.service import KINDS, TrainingDesk
from tests.web.conftest import Service

URL, EFFECTS, FAULTS = "/api/v1/emulator/training", "/api/v1/emulator/effects", "/api/v1/emulator/faults"


@pytest.fixture
def desk(service: Service, emulated_rig: EmulatedRig) -> Service:
    runtime = service.runtime
    runtime.rig = emulated_rig
    runtime.training = TrainingDesk(
        emulated_rig, runtime.store, lambda: runtime.orchestrator.running, Random(3)
    )
    return service


def ask(desk: Service, path: str = "", body: dict[str, Any] | None = None) -> dict[str, Any]:
    answer = desk.client.post(URL + path, json=body)
    assert answer.status_code in (200, 201), answer.text
    view: dict[str, Any] = answer.json()
    return view


def test_a_station_with_real_devices_has_none(service: Service) -> None:
    assert service.client.get(URL).status_code == 404
    for path in ("", "/draw", "/reveal", "/repair"):
        assert service.client.post(URL + path, json={"kind": "backlash"}).status_code in (404, 422)


def test_what_is_chosen_is_wrong_until_it_is_repaired(desk: Service) -> None:
    current = ask(desk, body={"kind": "backlash", "joint": 2, "size": 0.06})["current"]
    assert (current["challenge"]["kind"], current["joint"], current["size"]) == ("backlash", 2, 0.06)
    assert current["revealed"] and not current["unseen"] and current["said"] is None
    (effect,) = desk.client.get(EFFECTS).json()
    assert (effect["kind"], effect["joint"], effect["width_deg"]) == ("backlash", 2, 0.06)
    ask(desk, body={"kind": "scale silent"})
    assert desk.client.get(EFFECTS).json() == [], "one thing at a time"
    assert desk.client.get(FAULTS).json()[0]["kind"] == "silent"
    view = ask(desk, "/repair")
    assert view["current"] is None and [done["n"] for done in view["done"]] == [2, 1]
    assert desk.client.get(FAULTS).json() == []


def test_what_is_drawn_is_told_only_when_somebody_asks(desk: Service) -> None:
    current = ask(desk, "/draw", {"groups": ["catalogue"]})["current"]
    assert current["unseen"] and not current["revealed"]
    assert [current[key] for key in ("challenge", "joint", "size")] == [None] * 3
    for hidden in (EFFECTS, FAULTS):
        refused = desk.client.get(hidden)
        assert (refused.status_code, "unseen" in refused.json()["detail"]) == (409, True)
    assert "kind" not in str(desk.client.get("/api/v1/audit").json()["items"][0]["after"])
    told = ask(desk, "/reveal")["current"]
    assert KINDS[told["challenge"]["kind"]].group == "catalogue"
    assert desk.client.get(EFFECTS).json()[0]["kind"] == told["challenge"]["kind"]
    ask(desk, "/repair")


def test_the_end_of_a_run_reveals_it_and_is_scored(desk: Service) -> None:
    ask(desk, "/draw", {"groups": ["catalogue"]})
    run = desk.complete()
    current = desk.client.get(URL).json()["current"]
    assert current["revealed"] and current["said"]["run"] == run
    assert (current["said"]["outcome"], current["score"]) == ("good", "missed")
    ask(desk, "/repair")
    desk.complete()
    assert desk.client.get(URL).json()["done"][0]["said"]["run"] == run, (
        "the repaired machine says nothing of it"
    )


def test_nothing_becomes_wrong_during_a_run(desk: Service) -> None:
    run = desk.hold()
    refused = desk.client.post(URL, json={"kind": "drift"})
    assert (refused.status_code, f"Run {run}" in refused.json()["detail"]) == (409, True)
    assert desk.client.post(f"{URL}/draw", json={}).status_code == 409
    ask(desk, "/repair")  # there is always a way back
    desk.client.post("/api/v1/stop")


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"kind": "tired"}, "kind"),
        ({"kind": "backlash"}, "joint"),
        ({"kind": "backlash", "joint": 3}, "joint"),
        ({"kind": "backlash", "joint": True}, "joint"),
        ({"kind": "backlash", "joint": 1, "size": 40}, "size"),
        ({"kind": "drift", "size": False}, "size"),
        ({"kind": "drift", "speed": 1}, "speed"),
    ],
)
def test_what_cannot_be_is_refused(desk: Service, body: dict[str, Any], field: str) -> None:
    refused = desk.client.post(URL, json=body)
    assert (refused.status_code, refused.json()["field"]) == (422, field)


def test_there_is_nothing_to_reveal_before_the_first_exercise(desk: Service) -> None:
    assert desk.client.post(f"{URL}/reveal").status_code == 404


@pytest.mark.parametrize("name", KINDS)
def test_the_machine_takes_every_kind(emulated_rig: EmulatedRig, name: str) -> None:
    kind = KINDS[name]
    joint = 1 if kind.joint else None
    for size in kind.sizes or (None,):
        faults = emulated_rig.order(kind.faults(joint))
        effects = emulated_rig.order_effects(kind.effects(joint, size))
        assert len(faults) + len(effects) == 1
