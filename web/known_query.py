"""Unknown query parameters are refused.

A filter with a typing error in its name must not return all runs.
"""

from __future__ import annotations

from fastapi import Request
from fastapi.dependencies.utils import get_flat_params
from fastapi.params import Cookie, Header, Path

from station.errors import FieldRefused


async def known_query(request: Request) -> None:
    """A dependency of every route. :raises FieldRefused: the route does not accept a parameter."""
    if not request.query_params:
        return
    taken = get_flat_params(request.scope["route"].dependant)
    known = sorted(p.alias for p in taken if not isinstance(p.field_info, Path | Header | Cookie))
    for name in request.query_params:
        if name not in known:
            there = f"there is {', '.join(known)}" if known else "there is none here"
            raise FieldRefused(name, f"{name} is no query parameter of this address; {there}.")
