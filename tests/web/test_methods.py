"""HEAD, `Allow`, and what an answer says of its connection."""

from __future__ import annotations

import pytest

from station.store.store import Store
from tests.web.conftest import Service

RUNS = "/api/v1/calibrations"


def test_head_answers_as_get_without_the_body(service: Service) -> None:
    run = service.complete()
    paths = [RUNS, f"{RUNS}/{run}", f"{RUNS}/{run}/readings.csv", "/healthz", "/openapi.json"]
    for path in paths:
        got, head = service.client.get(path), service.client.head(path)
        assert (head.status_code, head.content) == (200, b""), path
        assert dict(head.headers) == dict(got.headers), path
    assert service.client.head(f"{RUNS}/99").status_code == 404
    assert service.client.head(RUNS, params={"workorder": "1"}).status_code == 422


@pytest.mark.parametrize(
    ("method", "path", "allow"),
    [
        ("DELETE", RUNS, "GET, HEAD, POST"),
        ("PUT", f"{RUNS}/1", "GET, HEAD"),
        ("GET", f"{RUNS}/1/abort", "POST"),
        ("HEAD", f"{RUNS}/1/abort", "POST"),
        ("POST", "/api/v1/robots/line/7/memory", "DELETE, GET, HEAD, PUT"),
        ("PUT", "/api/v1/stop", "POST"),
        ("POST", "/", "GET, HEAD"),
        ("POST", "/assets/none.js", "GET, HEAD"),
    ],
)
def test_a_wrong_method_says_which_there_are(service: Service, method: str, path: str, allow: str) -> None:
    answer = service.client.request(method, path)
    assert (answer.status_code, answer.headers["allow"]) == (405, allow)


def test_the_end_of_a_connection_after_a_failure_is_announced(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError

    monkeypatch.setattr(Store, "calibrations", broken)
    answer = service.client.get(RUNS)
    assert (answer.status_code, answer.headers["connection"]) == (500, "close")
