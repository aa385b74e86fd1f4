"""Stops are recorded beside, since a database that is locked must keep the drives' answer from nobody."""

from __future__ import annotations

import logging
from threading import Thread

from station.errors import StoreUnavailable
from station.store import Store

log = logging.getLogger(__name__)


class StopRecords:
    """Each on a thread of its own."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._under_way: list[Thread] = []

    def begin(self, run_id: int | None, who: str, trouble: dict[str, str]) -> None:
        """Record a stop that was carried out; returns at once."""
        record = Thread(
            target=self._record, args=(run_id, who, trouble), name="record of a stop", daemon=True
        )
        self._under_way = [thread for thread in self._under_way if thread.is_alive()] + [record]
        record.start()

    def join(self, limit_s: float) -> None:
        """Wait for those under way, each for so long."""
        for record in self._under_way:
            record.join(limit_s)

    def _record(self, run_id: int | None, who: str, trouble: dict[str, str]) -> None:
        try:
            self._store.add_event(run_id, "stop", {"by": who, **trouble})
        except StoreUnavailable:
            log.exception("The stop could not be recorded")  # it was carried out all the same
