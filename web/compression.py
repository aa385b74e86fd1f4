"""Compressed answers for clients that accept gzip (RFC 9110, section 12.5.3)."""

from __future__ import annotations

import zlib

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from web.aside import aside

LEAST_BYTES = 1000
"""Below this size, the headers would exceed the savings."""
INLINE_BYTES = 20_000
"""Up to this size, compressed at once, in less than a millisecond; otherwise on a thread."""
LEVEL = 4
_GZIP_WINDOW = 31
_TEXT = ("application/json", "application/problem+json", "text/", "image/svg+xml", "application/javascript")


class Compression:
    """Compresses text that is sent whole or in pieces; the live feed is not compressed."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or not _takes_gzip(Headers(scope=scope)):
            await self.app(scope, receive, send)
            return
        start: Message | None = None
        packing: zlib._Compress | None = None

        async def packed(message: Message) -> None:
            nonlocal start, packing
            if message["type"] == "http.response.start":
                if _fits(message):
                    start = message
                else:
                    await send(message)
                return
            if message["type"] != "http.response.body" or (start is None and packing is None):
                await send(message)
                return
            body, more = message.get("body", b""), message.get("more_body", False)
            if start is not None:
                if not more and len(body) < LEAST_BYTES:
                    await send(start)
                    await send(message)
                    start = None
                    return
                packing = zlib.compressobj(LEVEL, zlib.DEFLATED, _GZIP_WINDOW)
                await send(_as_gzip(start))
                start = None
            assert packing is not None
            piece = await _pack(packing, body, last=not more)
            await send({"type": "http.response.body", "body": piece, "more_body": more})

        await self.app(scope, receive, packed)


def _takes_gzip(headers: Headers) -> bool:
    given = (part.strip().partition(";") for part in headers.get("accept-encoding", "").split(","))
    return any(name.strip() == "gzip" and weight.replace(" ", "") != "q=0" for name, _, weight in given)


def _fits(start: Message) -> bool:
    headers = Headers(raw=start["headers"])
    kind = headers.get("content-type", "")
    return (
        start["status"] not in (204, 304, 206)
        and kind.startswith(_TEXT)
        and "content-encoding" not in headers
    )


def _as_gzip(start: Message) -> Message:
    headers = MutableHeaders(raw=list(start["headers"]))
    del headers["content-length"]
    headers["Content-Encoding"] = "gzip"
    headers.add_vary_header("Accept-Encoding")
    if tag := headers.get("etag"):  # the same content with other bytes
        headers["ETag"] = tag if tag.startswith("W/") else f"W/{tag}"
    return {**start, "headers": headers.raw}


async def _pack(packing: zlib._Compress, body: bytes, *, last: bool) -> bytes:
    def pack() -> bytes:
        piece = packing.compress(body)
        return piece + (packing.flush() if last else packing.flush(zlib.Z_SYNC_FLUSH))

    return pack() if len(body) < INLINE_BYTES else await aside(pack)
