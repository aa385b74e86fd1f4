"""The history in SQLite: every reading is on disk before the next move."""

from __future__ import annotations

from station.store.rows import Page, compact
from station.store.store import Store
from station.store.zero_state import application, check_apply, check_roll_back, rolled_back_by

__all__ = [
    "Page",
    "Store",
    "application",
    "check_apply",
    "check_roll_back",
    "compact",
    "rolled_back_by",
]
