"""Alive, ready, and what is missing."""

from __future__ import annotations

import pytest

from drivers.errors import LinkLost
from tests.web.conftest import Service
from web.routes import health


def test_a_process_that_answers_is_alive(service: Service) -> None:
    assert service.client.get("/healthz").json() == {"status": "alive"}


def test_ready_when_devices_and_interlocks_are_well(service: Service) -> None:
    service.complete()
    answer = service.client.get("/readyz")
    assert (answer.status_code, answer.json()) == (200, {"status": "ready"})


def test_a_lost_device_is_named(service: Service) -> None:
    nothing = LinkLost("scale: nothing answers")
    for call in ("scale connect", "scale read"):  # the idle watch may have connected it already
        service.rig.script.fail(call, nothing)
    service.complete()
    answer = service.client.get("/readyz")
    assert answer.status_code == 503
    assert any("nothing answers" in text for text in answer.json()["missing"])
    assert service.client.get("/healthz").status_code == 200


def test_an_orchestrator_that_hangs_is_named(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(health, "SNAPSHOT_TIMEOUT_S", 0.1)
    monkeypatch.setattr(service.runtime.orchestrator, "snapshot", service.rig.released.wait)
    answer = service.client.get("/readyz")
    assert (answer.status_code, answer.json()["missing"]) == (503, ["the orchestrator does not answer"])
    service.rig.released.set()


def test_a_database_that_is_gone_is_named(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    def gone(**_: object) -> None:
        raise OSError("disk is gone")

    monkeypatch.setattr(service.runtime.store, "calibrations", gone)
    assert "disk is gone" in service.client.get("/readyz").json()["detail"]
