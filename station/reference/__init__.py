"""The pages of docs/reference, made from the code: `make reference`."""

from __future__ import annotations

from station.reference.pages import pages
from station.reference.roles import RouteNeed, route_needs

__all__ = [
    "RouteNeed",
    "pages",
    "route_needs",
]
