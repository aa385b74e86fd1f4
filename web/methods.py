"""HEAD for every GET, and the methods of an address."""

from __future__ import annotations

from collections.abc import Sequence

from fastapi.routing import iter_route_contexts
from starlette.routing import BaseRoute, compile_path
from starlette.types import ASGIApp, Message, Receive, Scope, Send

FILES_TAKE = "GET, HEAD"
"""Methods of the mounted folders of files, which are no routes."""


class HeadAsGet:
    """Answers HEAD with the status and headers of GET and no body (RFC 9110, section 9.3.2)."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return

        async def send_without_body(message: Message) -> None:
            if message["type"] == "http.response.body":
                message = {**message, "body": b""}
            await send(message)

        await self.app({**scope, "method": "GET"}, receive, send_without_body)


def allowed(routes: Sequence[BaseRoute], path: str) -> str:
    """The value of `Allow` for a path: the methods of all its routes."""
    methods: set[str] = set()
    for route in iter_route_contexts(routes):
        if route.path is not None and route.methods and compile_path(route.path)[0].match(path):
            methods |= route.methods
    if "GET" in methods:
        methods.add("HEAD")
    return ", ".join(sorted(methods)) or FILES_TAKE
