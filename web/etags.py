"""`ETag` for the data of a run, so that unchanged data need not be sent again."""

from __future__ import annotations

import hashlib

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

KEPT_BUT_ASKED_FOR = "private, no-cache"
"""The client may store the answer, but must revalidate it each time: an application may be added."""


class ETags:
    """Marks GET answers under a prefix with the hash of their body; 304 if the client has that one.

    The answers of a finished run do not change; changed answers have another hash, so that this needs no
    knowledge of the run (RFC 9110, section 13.1.2).
    """

    def __init__(self, app: ASGIApp, prefix: str) -> None:
        self.app, self._prefix = app, prefix

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] != "GET" or not scope["path"].startswith(self._prefix):
            await self.app(scope, receive, send)
            return
        start: Message | None = None
        body = bytearray()

        async def collect(message: Message) -> None:
            nonlocal start
            if message["type"] == "http.response.start" and message["status"] == 200:
                start = message
            elif start is None or message["type"] != "http.response.body":
                await send(message)
            else:
                body.extend(message.get("body", b""))
                if not message.get("more_body"):
                    await _answer(start, bytes(body), scope, receive, send)

        await self.app(scope, receive, collect)


async def _answer(start: Message, body: bytes, scope: Scope, receive: Receive, send: Send) -> None:
    tag = f'"{hashlib.sha256(body).hexdigest()[:32]}"'
    if _has(Headers(scope=scope).getlist("if-none-match"), tag):
        kept = Response(status_code=304, headers={"ETag": tag, "Cache-Control": KEPT_BUT_ASKED_FOR})
        await kept(scope, receive, send)
        return
    headers = MutableHeaders(scope=start)
    headers["ETag"] = tag
    headers.setdefault("Cache-Control", KEPT_BUT_ASKED_FOR)
    await send(start)
    await send({"type": "http.response.body", "body": body})


def _has(if_none_match: list[str], tag: str) -> bool:
    given = [part.strip().removeprefix("W/") for line in if_none_match for part in line.split(",")]
    return tag in given or "*" in given
