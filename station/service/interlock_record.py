"""Interlocks in the record: violations during a run, and their ends, as events of the run."""

from __future__ import annotations

import logging
from collections.abc import Callable

from station.errors import StoreUnavailable
from station.motion import LiveEvent
from station.records import Interlock
from station.store import Store

log = logging.getLogger(__name__)


class InterlockRecord:
    """A listener; an interlock that was violated when the run began is not an event of the run."""

    def __init__(self, store: Store, run_under_way: Callable[[], int | None]) -> None:
        self._store = store
        self._run_under_way = run_under_way
        self._held: dict[str, bool] = {}
        self._broken_in: dict[str, int] = {}
        """The run in which an interlock was violated that is not satisfied yet."""

    def __call__(self, event: LiveEvent) -> None:
        if event.type != "interlock" or not isinstance(event.data, tuple):
            return
        run = self._run_under_way()
        for interlock in event.data:
            broke = self._held.get(interlock.id, False) and not interlock.ok
            holds_again = interlock.ok and self._broken_in.pop(interlock.id, None) == run
            self._held[interlock.id] = interlock.ok
            if run is not None and (broke or holds_again):
                if broke:
                    self._broken_in[interlock.id] = run
                self._record(run, interlock)

    def _record(self, run: int, interlock: Interlock) -> None:
        try:
            self._store.add_event(run, "interlock", interlock.model_dump(exclude={"own_text", "last_trip"}))
        except StoreUnavailable:
            log.exception("That the interlock %s changed could not be recorded", interlock.id)
