"""People and programs that ask the station over REST: the requests that a browser or a MES would send."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from starlette.types import Message, Scope

from station.simulation.plant import NotRunning, Plant

API = "/api/v1"
_HOST = b"127.0.0.1:8000"
_UNAUTHORIZED = 401


@dataclass(frozen=True, slots=True)
class Answer:
    """An answer of the station."""

    status: int
    body: Any
    cookie: str | None

    @property
    def run(self) -> int:
        """Number of the started run; 0 without one."""
        return int(self.body["id"]) if self.status == 202 else 0


@dataclass
class Client:
    """A client that sends the same key or session with each request."""

    plant: Plant
    name: str
    """Its name in the audit."""
    headers: dict[str, str] = field(default_factory=dict)
    address: str = "127.0.0.1"

    def send(
        self,
        method: str,
        path: str,
        body: Mapping[str, object] | None = None,
        *,
        key: str | None = None,
        query: str = "",
    ) -> Answer:
        """Send a request, and wait for the answer.

        :param key: idempotency key
        :raises NotRunning: the station does not run, or was killed before it answered
        """
        request = Request(method, path, body, key, query)
        answer = self._ask(request)
        return self._ask(request) if answer.status == _UNAUTHORIZED and self._sign_in() else answer

    def _sign_in(self) -> bool:
        """After a refusal: sign in again; returns whether there are new credentials."""
        return False

    def _ask(self, request: Request) -> Answer:
        """Send the request once, with the present credentials. :raises NotRunning:"""
        exchange = _Exchange(request.content)
        self.plant.serve(request.scope(self.headers, self.address), exchange)
        if not exchange.done:
            raise NotRunning
        return exchange.answer


@dataclass(frozen=True, slots=True)
class Request:
    """A request, independent of its sender."""

    method: str
    path: str
    body: Mapping[str, object] | None = None
    key: str | None = None
    query: str = ""

    @property
    def content(self) -> bytes:
        return b"" if self.body is None else json.dumps(self.body).encode()

    def scope(self, shown: Mapping[str, str], address: str) -> Scope:
        """:param shown: headers that identify the sender"""
        headers = {**shown, **({"Idempotency-Key": self.key} if self.key else {})}
        if self.body is not None:
            headers |= {"Content-Type": "application/json", "Content-Length": str(len(self.content))}
        return {
            "type": "http",
            "asgi": {"version": "3.0", "spec_version": "2.3"},
            "http_version": "1.1",
            "method": self.method,
            "scheme": "http",
            "path": f"{API}{self.path}",
            "raw_path": f"{API}{self.path}".encode(),
            "root_path": "",
            "query_string": self.query.encode(),
            "headers": [(b"host", _HOST), *((k.lower().encode(), v.encode()) for k, v in headers.items())],
            "client": (address, 50_000),
            "server": ("127.0.0.1", 8000),
            "state": {},
        }


class _Exchange:
    """The client's end of one request."""

    def __init__(self, content: bytes) -> None:
        self._content: bytes | None = content
        self._start: Message = {}
        self._received = b""
        self.done = False
        """Whether the answer is complete; later work of the server is not visible to the client."""

    async def receive(self) -> Message:
        if self._content is None:
            return {"type": "http.disconnect"}
        content, self._content = self._content, None
        return {"type": "http.request", "body": content, "more_body": False}

    async def send(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            self._start = message
        elif message["type"] == "http.response.body":
            self._received += message.get("body", b"")
            self.done = not message.get("more_body", False)

    @property
    def answer(self) -> Answer:
        headers = dict(self._start["headers"])
        cookie = headers.get(b"set-cookie")
        is_json = b"json" in headers.get(b"content-type", b"")
        return Answer(
            self._start["status"],
            json.loads(self._received) if is_json else None,
            None if cookie is None else cookie.decode().partition(";")[0],
        )
