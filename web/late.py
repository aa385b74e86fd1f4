"""Commands from a page are valid for a short time only."""

from __future__ import annotations

import time

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from web.problems import problem

HEADER = "X-Not-After"
MALFORMED = f"{HEADER} must be the time in ms since 1970, a whole number."


class LateCommands:
    """Refuses with 412 commands after the time in their `X-Not-After`, ms since 1970 by the station's clock.

    A station that was suspended receives the commands sent meanwhile. By then the page has told the operator
    that it does not respond, and the operator may be at the machine.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        given = Headers(scope=scope).get(HEADER) if scope["type"] == "http" else None
        if given is None:
            await self._app(scope, receive, send)
        elif not given.isascii() or not given.isdigit():
            await problem(422, MALFORMED, kind="refused")(scope, receive, send)
        elif time.time() * 1e3 > int(given):
            refusal = problem(
                412,
                "The command came too late and was not carried out; look at the machine, then try again.",
                kind="too-late",
            )
            await refusal(scope, receive, send)
        else:
            await self._app(scope, receive, send)
