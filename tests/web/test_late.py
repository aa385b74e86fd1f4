"""A command that comes after its time is not carried out."""

from __future__ import annotations

import time

import pytest

from tests.web.conftest import BODY, Service

RUNS = "/api/v1/calibrations"


def in_ms(seconds: float) -> str:
    return str(round((time.time() + seconds) * 1e3))


@pytest.mark.parametrize(
    ("not_after", "status", "kind"),
    [
        ("a second ago", 412, "urn:station:problem:too-late"),
        ("0", 412, "urn:station:problem:too-late"),
        ("soon", 422, "urn:station:problem:refused"),
        ("-1", 422, "urn:station:problem:refused"),
        ("²", 422, "urn:station:problem:refused"),
    ],
)
def test_it_starts_nothing(service: Service, not_after: str, status: int, kind: str) -> None:
    not_after = in_ms(-1.0) if not_after == "a second ago" else not_after
    answer = service.client.post(RUNS, json=BODY, headers=[(b"X-Not-After", not_after.encode())])
    assert (answer.status_code, answer.json()["type"]) == (status, kind)
    assert service.client.get(RUNS).json()["items"] == []


def test_in_time_it_starts(service: Service) -> None:
    answer = service.client.post(RUNS, json=BODY, headers={"X-Not-After": in_ms(600.0)})
    assert answer.status_code == 202
