"""A time limit for bodies, so that a client cannot hold a connection by sending single bytes slowly."""

from __future__ import annotations

from http import HTTPStatus

from anyio import current_time, fail_after
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LIMIT_S = 30.0
WITHOUT_BODY = ("GET", "HEAD", "OPTIONS")


class SlowBodies:
    """Ends requests whose whole body has not arrived within `limit_s` with 408, and their connections."""

    def __init__(self, app: ASGIApp, limit_s: float = LIMIT_S) -> None:
        self.app, self._limit_s = app, limit_s

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] in WITHOUT_BODY:
            await self.app(scope, receive, send)
            return
        until, complete = current_time() + self._limit_s, False

        async def receive_in_time() -> Message:
            nonlocal complete
            if complete:
                return await receive()  # waits for the end of the connection, without a limit
            try:
                with fail_after(until - current_time()):
                    message = await receive()
            except TimeoutError as late:
                raise HTTPException(
                    HTTPStatus.REQUEST_TIMEOUT,
                    f"The body did not arrive within {self._limit_s:g} s; send it again, at once.",
                    headers={"Connection": "close"},
                ) from late
            complete = not message.get("more_body", False)
            return message

        await self.app(scope, receive_in_time, send)
