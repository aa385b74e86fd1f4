"""The permissions of a route, declared at the route, and checked before its body is read."""

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
from station.records import Actor, one_line
from web.aside import aside
from web.cookies import sent_session, sent_sessions
from web.problems import documented
from web.strict_json import StrictRequest, is_json

UNATTENDED = "x-unattended"
"""Header of automatic requests of the page, without user activity."""
NOBODY = Actor(name="nobody", via="open")
"""The author of a request before authentication."""
_OF_PROXIES = frozenset({"forwarded", "via", "x-real-ip"})
"""Headers that only a proxy adds; beside the family `X-Forwarded-`."""
LOOKUP_LIMIT_S = 1.0
"""Maximum time that a stop waits for a history that hangs."""


class Needs:
    """The dependency that every route has exactly once."""

    def __init__(self, permission: Permission) -> None:
        self.permission = permission

    async def __call__(self, connection: HTTPConnection) -> Actor:
        """The author of the request.

        :raises NotSignedIn: the author is unknown.
        :raises Forbidden: the role has no permission.
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
        """The panel needs no sign-in, and an unreadable history prevents nobody from stopping."""
        refused = NotSignedIn()
        # a cookie set by another host must not prevent a stop
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
    """For the `dependencies` of a route, or as the default of a parameter that receives the author."""
    return Depends(Needs(permission))


async def who_asks(connection: HTTPConnection) -> Actor:
    """The author by key, otherwise by session. :raises NotSignedIn: with the reason."""
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
    """Whether this request shows activity of a user, which extends the session.

    An unattended page continues its requests, and reopens its live feed: these are marked and do not count.
    """
    return connection.scope["type"] == "http" and UNATTENDED not in connection.headers


def bearer(connection: HTTPConnection) -> str | None:
    """The key in the header. :raises NotSignedIn: the header has another form."""
    given = connection.headers.getlist("authorization")
    if not given:
        return None
    scheme, _, key = given[0].partition(" ")
    if len(given) > 1 or scheme.lower() != "bearer" or not key.strip():
        raise NotSignedIn("The header `Authorization` must be `Bearer KEY`.")
    return key.strip()


def named(connection: HTTPConnection) -> str | None:
    """The name in `X-Operator`, which counts only if nobody can sign in."""
    return one_line(unquote(connection.headers.get("x-operator", "")))[:64].strip() or None


def at_the_panel(connection: HTTPConnection) -> bool:
    """Whether the request comes from this computer itself, not through a proxy on it."""
    try:
        address = ipaddress.ip_address(connection.client.host if connection.client else "")
    except ValueError:
        return False
    through = any(name in _OF_PROXIES or name.startswith("x-forwarded-") for name in connection.headers)
    return address.is_loopback and (not through or "forwarded_by" in connection.scope)


class GuardedRoute(APIRoute):
    """Determines the author before it reads the body, and parses JSON strictly."""

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
    """The permission that a route declares; None if it declares none or more than one."""
    found = [d.call for d in dependant.dependencies if isinstance(d.call, Needs)]
    return found[0] if len(found) == 1 else None


class Router(APIRouter):
    """A router of guarded routes."""

    def __init__(self, **options: Any) -> None:
        super().__init__(route_class=GuardedRoute, **options)
