"""JSON that cannot be stored or sent again is refused with the field, and bodies that are too large."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.web.conftest import BODY, Service

RUNS = "/api/v1/calibrations"
START = b'{"robot_serial": "FB-1", "plan": "paper", "operator": "ada", "metadata": {"a": %s}}'


@pytest.mark.parametrize(
    "value",
    [
        b"NaN", b"Infinity", b"-Infinity", b"1e999", b"1" * 5000, b'"\\ud800"', b'"\\u0000"', b'"\\u001b[2J"',
        b'{"\\udfff": 1}', b"[" * 200 + b"]" * 200, b"\xff", b'"a', b"[" * 200_000,
    ],
)  # fmt: skip
def test_what_is_no_json_is_refused_in_words(service: Service, value: bytes) -> None:
    answer = service.client.post(RUNS, content=START % value, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422 and answer.json()["detail"], answer.text
    assert service.client.get(RUNS).json()["items"] == []


def test_more_than_a_megabyte_of_json_is_not_read(service: Service) -> None:
    big = {**BODY, "metadata": {"a": "x" * 1_100_000}}
    told = service.client.post(RUNS, json=big)
    assert (told.status_code, told.headers["content-type"]) == (413, "application/problem+json")
    assert "larger than 1000000 bytes" in told.json()["detail"]
    assert "content-security-policy" in told.headers

    def pieces() -> Iterator[bytes]:
        for _ in range(30):
            yield b" " * 50_000

    answer = service.client.post(RUNS, content=pieces(), headers={"Content-Type": "application/json"})
    assert answer.status_code == 413 and answer.json()["status"] == 413
    robot = {"Content-Type": "application/toml"}
    assert service.client.put("/api/v1/robots/FB-1", content=pieces(), headers=robot).status_code == 413
    assert service.client.get("/api/v1/station").status_code == 200


def test_who_may_not_ask_is_told_that_and_not_how_much_may_be_sent(closed: Service) -> None:
    assert closed.client.post(RUNS, content=b" " * 1_100_000).status_code == 401
    viewer = closed.key("viewer")
    assert closed.client.post(RUNS, content=b" " * 1_100_000, headers=viewer).status_code == 403
