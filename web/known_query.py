"""Query parameters that nobody knows are refused.

A filter with a slip in its name must not answer with everybody's runs.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable

from fastapi import Request

from station.errors import FieldRefused


def known_query(prefix: str) -> Callable[[Request], Awaitable[None]]:
    """A dependency for the routes of a router that is included under this prefix."""

    async def check(request: Request) -> None:
        """:raises FieldRefused: a parameter that the OpenAPI document does not have here."""
        path = prefix + request.scope["route"].path_format
        operation = request.app.openapi()["paths"][path][request.method.lower()]
        known = sorted(p["name"] for p in operation.get("parameters", []) if p["in"] == "query")
        for name in request.query_params:
            if name not in known:
                there = f"there is {', '.join(known)}" if known else "there is none here"
                raise FieldRefused(name, f"{name} is no query parameter of this address; {there}.")

    return check
