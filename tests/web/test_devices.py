"""What maintenance is shown of the devices, and the examination while the service runs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from station.service import Runtime
from station.settings import Settings
from tests.waiting import soon
from tests.web.conftest import Service
from web.app import create_app

DEVICES, DOCTOR = "/api/v1/devices", "/api/v1/doctor"


@pytest.fixture(scope="module")
def wired(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Runtime]:
    """A station with the emulated rig behind its wires."""
    home: Path = tmp_path_factory.mktemp("station")
    with Runtime.open(Settings(), home) as runtime:
        yield runtime


@pytest.fixture
def emulated(wired: Runtime) -> Iterator[TestClient]:
    with TestClient(create_app(wired), base_url="http://station") as client:
        yield client


def sentences(found: dict[str, Any]) -> list[str]:
    return [found["text"], *(text for part in found["parts"] for text in sentences(part))]


def test_each_device_tells_who_it_is_and_how_fast_it_answers(emulated: TestClient) -> None:
    soon(lambda: all(d["state"] == "ok" for d in emulated.get(DEVICES).json()["items"]))
    scale, axis1, axis2 = emulated.get(DEVICES).json()["items"]
    assert (scale["kind"], axis1["kind"], axis2["kind"]) == ("scale", "axis", "axis")
    assert "ND" in scale["identity"]
    assert 0 < scale["round_trip_ms"] < 1000 and 0 < axis1["round_trip_ms"] < 1000
    assert 0 <= scale["heard_s"] < 10 and scale["errors"] == 0
    assert scale["requests"] >= scale["replies"] > 0
    assert axis1["requests"] == axis2["requests"], "they share a line"


def test_the_examination_leaves_the_devices_open(emulated: TestClient) -> None:
    answer = emulated.post(DOCTOR)
    assert answer.status_code == 200, answer.text
    found = sentences(answer.json())
    assert any(text.startswith("answers: 5 replies") for text in found)
    assert "stands within its workspace" in found
    assert not [text for text in found if text.startswith("connects within")]
    assert all(device["state"] == "ok" for device in emulated.get(DEVICES).json()["items"])
    assert emulated.post("/api/v1/stop").json()["confirmed"]


def test_a_run_is_not_examined(service: Service) -> None:
    run = service.hold()
    refused = service.client.post(DOCTOR)
    assert (refused.status_code, refused.json()["calibration_id"]) == (409, run)
    service.client.post("/api/v1/stop")


def test_what_fails_in_the_examination_is_its_answer_and_the_worker_goes_on(service: Service) -> None:
    def fails(*_: object) -> None:
        raise ValueError("broken")

    with pytest.raises(ValueError, match="broken"):
        service.runtime.orchestrator.while_idle(fails, 5.0)
    assert service.complete() == 1
