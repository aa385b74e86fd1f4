"""Permissions of the routes: the table of routes and roles, from the routes themselves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from station.people import ALLOWED, ROLES, Permission
from station.reference.markdown import code, page, section, table
from web.app import API, LIVE_ROUTES, PROVIDER_ROUTES, ROUTES, TOP_ROUTES
from web.guarded import guard_of


@dataclass(frozen=True, slots=True)
class RouteNeed:
    """One route and the permission that it declares."""

    method: str
    path: str
    permission: Permission


def route_needs() -> Iterator[RouteNeed]:
    """Every route of the interface.  :raises LookupError: a route declares no permission, or two."""
    prefixed = [(module, API) for module in (*ROUTES, *PROVIDER_ROUTES, *LIVE_ROUTES)] + [
        (module, "") for module in TOP_ROUTES
    ]
    for module, prefix in prefixed:
        for route in module.router.routes:
            guard = guard_of(route.dependant)
            if guard is None:
                raise LookupError(f"{route.path} must declare what it needs, once")
            methods = getattr(route, "methods", None) or {"WebSocket"}
            for method in sorted(methods):
                yield RouteNeed(method, prefix + route.path_format, guard.permission)


def roles_page() -> str:
    """Permissions by role, and what every route needs."""
    return page(
        "Roles",
        "Every route declares one permission; a role is a set of permissions. `GET /healthz` and `/readyz`, the files of the "
        "page and `/docs` need no permission. At an open station (the emulated rig on a loopback address), a request without a key "
        "has all permissions; a request with a key has the role of the key.",
        section(
            "Permissions",
            table(
                ("permission", *ROLES),
                ((code(p), *(_mark(role in ALLOWED[p]) for role in ROLES)) for p in Permission),
            ),
            "",
            "`enter` is the permission to sign in and out; everybody has it. `stop` from the computer of the station needs no "
            "sign-in. With `abort`, the role `mes` can end only the runs that it started itself.",
        ),
        section(
            "Routes",
            table(
                ("route", "permission", *ROLES),
                (
                    (
                        code(f"{need.method} {need.path}"),
                        code(need.permission),
                        *(_mark(role in ALLOWED[need.permission]) for role in ROLES),
                    )
                    for need in sorted(route_needs(), key=lambda need: (need.path, need.method))
                ),
            ),
        ),
    )


def _mark(allowed: bool) -> str:
    return "yes" if allowed else ""
