"""A body that does not come is not waited for."""

from __future__ import annotations

import asyncio
import json

import pytest
from starlette.datastructures import Headers
from starlette.types import Message

from tests.web.conftest import BODY, Service
from web.slow_bodies import SlowBodies

RUNS, FILES = "/api/v1/calibrations", "/api/v1/datasets"


def answered(service: Service, path: str, kind: str, chunks: list[bytes], limit_s: float) -> list[Message]:
    """What is sent for a request of which no more than these chunks ever comes."""
    left, sent = list(chunks), list[Message]()
    scope = {
        "type": "http",
        "method": "POST",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "headers": [(b"host", b"station"), (b"content-type", kind.encode())],
        "http_version": "1.1",
        "scheme": "http",
        "client": ("127.0.0.1", 1),
        "server": ("station", 80),
    }

    async def receive() -> Message:
        if not left:
            await asyncio.Event().wait()
        return {"type": "http.request", "body": left.pop(0), "more_body": True}

    async def send(message: Message) -> None:
        sent.append(message)

    asyncio.run(SlowBodies(service.client.app, limit_s)(scope, receive, send))
    return sent


@pytest.mark.parametrize(("path", "kind"), [(RUNS, "application/json"), (FILES, "text/csv")])
def test_a_body_that_does_not_come_is_answered_408(service: Service, path: str, kind: str) -> None:
    start, body = answered(service, path, kind, [json.dumps(BODY).encode()[:-1], b""], 0.02)
    headers = Headers(raw=start["headers"])
    assert (start["status"], headers["connection"]) == (408, "close")
    assert headers["content-type"] == "application/problem+json"
    assert "did not arrive" in json.loads(body["body"])["detail"]
    assert service.client.get(RUNS).json()["items"] == []


def test_a_stop_waits_for_no_body(service: Service) -> None:
    start, _ = answered(service, "/api/v1/stop", "application/json", [], 600.0)
    assert start["status"] == 200
