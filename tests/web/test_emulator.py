"""Faults on order over REST: for the emulated machine only."""

from __future__ import annotations

import pytest

from station.motion import EmulatedRig
from tests.web.conftest import Service

URL = "/api/v1/emulator/faults"
JUMP = {"device": "scale", "kind": "jump", "mm": 0.1, "after_s": 1.0}


def test_a_station_with_real_devices_has_none(service: Service) -> None:
    assert service.client.get(URL).status_code == 404
    assert service.client.put(URL, json=[JUMP]).status_code == 404


def test_faults_are_ordered_and_taken_back(service: Service, emulated_rig: EmulatedRig) -> None:
    service.runtime.rig = emulated_rig
    assert service.client.get(URL).json() == []
    answer = service.client.put(URL, json=[JUMP])
    assert answer.status_code == 200
    (given,) = answer.json()
    assert {key: given[key] for key in JUMP} == JUMP
    assert service.client.get(URL).json() == answer.json()
    assert service.client.put(URL, json=[]).json() == []


def test_effects_of_the_machine_are_ordered(service: Service, emulated_rig: EmulatedRig) -> None:
    service.runtime.rig = emulated_rig
    url = "/api/v1/emulator/effects"
    answer = service.client.put(url, json=[{"kind": "backlash", "joint": 1, "width_deg": 0.05}])
    assert answer.status_code == 200, answer.json()
    assert answer.json()[0]["width_deg"] == 0.05
    assert service.client.get(url).json() == answer.json()
    refused = service.client.put(url, json=[{"kind": "tired"}])
    assert (refused.status_code, "refuses the effects" in refused.json()["detail"]) == (422, True)
    assert service.client.put(url, json=[]).json() == []


@pytest.mark.parametrize(
    "order",
    [
        {"device": "scale", "kind": "alarm"},
        {"device": "scale"},
        {**JUMP, "mm": "far"},
        {**JUMP, "x": 1},
        {**JUMP, "mm": True},
        {**JUMP, "after_s": False},
        {**JUMP, "count": True},
    ],
)
def test_what_cannot_be_ordered_is_refused(
    service: Service, emulated_rig: EmulatedRig, order: dict[str, object]
) -> None:
    service.runtime.rig = emulated_rig
    answer = service.client.put(URL, json=[order])
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"
