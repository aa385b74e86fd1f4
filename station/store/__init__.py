"""The history in SQLite: every reading is on disk before the next motion."""

from __future__ import annotations

from station.store.chain import Chained, Verified, link_hash
from station.store.filters import Filters, Order
from station.store.health import too_full
from station.store.opening import restore
from station.store.rewinding import found, rewind
from station.store.rows import Page, compact, request_hash
from station.store.store import Store
from station.store.tables import Columns

__all__ = [
    "Chained",
    "Columns",
    "Filters",
    "Order",
    "Page",
    "Store",
    "Verified",
    "compact",
    "found",
    "link_hash",
    "request_hash",
    "restore",
    "rewind",
    "too_full",
]
