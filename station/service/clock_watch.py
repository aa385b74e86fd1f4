"""Jumps of the computer's clock, recorded as events of the station."""

from __future__ import annotations

import logging
import time

from station.errors import StoreUnavailable
from station.store import Store

log = logging.getLogger(__name__)

JUMP_S = 2.0
"""A smaller change of the clock is a correction, not a jump."""


def _offset_s() -> float:
    """Difference of the clock from monotonic time."""
    return time.time() - time.monotonic()


class ClockWatch:
    """Compares the clock with the last record at the start, and with monotonic time from then on."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._offset_s = _offset_s()
        latest = store.latest_time()
        if latest is not None and (behind_s := latest.timestamp() - time.time()) >= JUMP_S:
            self._record("clock_behind", -behind_s)

    def look(self) -> None:
        """Check for a jump; call it often, since drift in between is not a jump."""
        offset_s = _offset_s()
        jump_s = offset_s - self._offset_s
        if abs(jump_s) < JUMP_S or self._record("clock_jump", jump_s):
            self._offset_s = offset_s

    def _record(self, kind: str, by_s: float) -> bool:
        """Record a jump. Returns whether the store accepted it; otherwise it is tried again."""
        log.warning("The clock jumped by %.1f s (%s)", by_s, kind)
        try:
            self._store.add_event(None, kind, {"by_s": round(by_s, 1)})
        except StoreUnavailable:
            return False
        return True
