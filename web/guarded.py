"""What a route needs, declared where the route is, and checked before anything of its body is read."""

from __future__ import annotations

import ipaddress
from collections.abc import Awaitable, Callable
from typing import Any
from urllib.parse import unquote

from fastapi import APIRouter, Depends, Request, Response
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute
from starlette.requests import HTTPConnection

from station.errors import NotSignedIn, StoreUnavailable
from station.people import Access, Permission
from station.records import Actor
from web.aside import aside
from web.cookies import sent_session, sent_sessions
from web.problems import documented
from web.strict_json import StrictRequest, is_json

UNATTENDED = "x-unattended"
"""Header of what the page asks by itself, while nobody touches it."""
NOBODY = Actor(name="nobody", via="open")
"""Who has not said who they are, on the way in."""
_OF_PROXIES = frozenset({"forwarded", "via", "x-real-ip"})
"""Headers that only a proxy adds; beside the family `X-Forwarded-`."""
LOOKUP_LIMIT_S = 1.0
"""Whoever wants to stop does not wait longer for a history that hangs."""


class Needs:
    """The dependency that every route has exactly once."""

    def __init__(self, permission: Permission) -> None:
        self.permission = permission

    async def __call__(self, connection: HTTPConnection) -> Actor:
        """Who asks.

        :raises NotSignedIn: nobody who is known.
        :raises Forbidden: not in a role that may.
        """
        if (known := getattr(connection.state, "actor", None)) is not None:
            return known  # type: ignore[no-any-return]
        if self.permission is Permission.ENTER:
            return NOBODY
        who = self._who_stops if self.permission is Permission.STOP else self._who
        actor = await who(connection)
        connection.state.actor = actor
        return actor

    async def _who(self, connection: HTTPConnection) -> Actor:
        actor = await who_asks(connection)
        Access.check(actor, self.permission)
        return actor

    async def _who_stops(self, connection: HTTPConnection) -> Actor:
        """The panel needs no sign-in, and a history that cannot be read keeps nobody from a stop."""
        refused = NotSignedIn()
        # one that another host has set stops no stop
        sessions: list[str | None] = [*sent_sessions(connection)] or [None]
        for session in sessions:
            try:
                return await _known(connection, session, LOOKUP_LIMIT_S)
            except NotSignedIn as error:
                refused = error
            except (StoreUnavailable, TimeoutError):
                return Actor(name=named(connection) or "unknown", via="panel")
        if at_the_panel(connection):
            return Actor(name=named(connection) or "panel", via="panel")
        raise refused


def needs(permission: Permission) -> Any:
    """For the `dependencies` of a route, or as the default of a parameter that is told who asks."""
    return Depends(Needs(permission))


async def who_asks(connection: HTTPConnection) -> Actor:
    """By key, else by session.  :raises NotSignedIn: says why."""
    return await _known(connection, sent_session(connection))


async def _known(connection: HTTPConnection, session: str | None, timeout_s: float | None = None) -> Actor:
    access: Access = connection.app.state.access
    key = bearer(connection)
    if access.open and key is None and session is None:
        return access.actor(None, None, named=named(connection))  # nothing to look up
    active = attended(connection)
    return await aside(
        lambda: access.actor(key, session, named=named(connection), active=active), timeout_s=timeout_s
    )


def attended(connection: HTTPConnection) -> bool:
    """Whether this is a sign of somebody at the page, who stays signed in by it.

    A page that was left alone goes on asking, and opens its live feed again: it says so, and that does not
    count.
    """
    return connection.scope["type"] == "http" and UNATTENDED not in connection.headers


def bearer(connection: HTTPConnection) -> str | None:
    """The key that is shown.  :raises NotSignedIn: the header has another form."""
    given = connection.headers.getlist("authorization")
    if not given:
        return None
    scheme, _, key = given[0].partition(" ")
    if len(given) > 1 or scheme.lower() != "bearer" or not key.strip():
        raise NotSignedIn("The header `Authorization` must be `Bearer KEY`.")
    return key.strip()


def named(connection: HTTPConnection) -> str | None:
    """The name in `X-Operator`, which counts only where nobody signs in."""
    return unquote(connection.headers.get("x-operator", ""))[:64].strip() or None


def at_the_panel(connection: HTTPConnection) -> bool:
    """Whether the request comes from this computer itself, not through a proxy on it."""
    try:
        address = ipaddress.ip_address(connection.client.host if connection.client else "")
    except ValueError:
        return False
    through = any(name in _OF_PROXIES or name.startswith("x-forwarded-") for name in connection.headers)
    return address.is_loopback and (not through or "forwarded_by" in connection.scope)


class GuardedRoute(APIRoute):
    """Asks who it is before it reads the body, and reads JSON strictly."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        by_hand = "requestBody" in (self.openapi_extra or {})
        if by_hand or self.body_field is not None:  # it may be too slow or too large
            self.responses = {**documented(408, 413), **self.responses}

    def get_route_handler(self) -> Callable[[Request], Awaitable[Response]]:  # type: ignore[override]
        handler = super().get_route_handler()
        guard, reads_json = guard_of(self.dependant), self.body_field is not None

        async def guarded(request: Request) -> Response:
            if guard is not None:
                await guard(request)
            strict = StrictRequest(request.scope, request.receive)
            if reads_json and is_json(strict.headers.get("content-type", "")):
                await strict.json()  # here, since a refusal would become a bare 400 there
            return await handler(strict)

        return guarded


def guard_of(dependant: Dependant) -> Needs | None:
    """What a route declares; None where it declares nothing or more than once."""
    found = [d.call for d in dependant.dependencies if isinstance(d.call, Needs)]
    return found[0] if len(found) == 1 else None


class Router(APIRouter):
    """Of guarded routes."""

    def __init__(self, **options: Any) -> None:
        super().__init__(route_class=GuardedRoute, **options)
