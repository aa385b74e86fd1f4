"""Records of completed actions, written in the background and repeated until the database accepts them.

A locked database must not delay the drives' answer, and a stop must still be in the audit.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from threading import Event, Lock, Thread

from pydantic import JsonValue

from station.errors import StoreUnavailable
from station.records import Actor
from station.store import Store

log = logging.getLogger(__name__)

PAUSE_S = 0.5
"""Pause between two attempts; each attempt itself waits for another program's lock."""


@dataclass(frozen=True, slots=True)
class _Late:
    what: str
    write: Callable[[], None]
    written: Event = field(default_factory=lambda: Event())


class LateRecords:
    """Records in order, on a thread that runs while any are waiting."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._lock, self._closing = Lock(), Event()
        self._waiting: deque[_Late] = deque()
        self._thread: Thread | None = None

    def stop(self, run_id: int | None, who: str, trouble: Mapping[str, str]) -> None:
        """Record a completed stop as an event of the run or the station; returns at once."""
        event: dict[str, JsonValue] = {"by": who, **trouble}
        self._add(f"stop by {who}", lambda: self._store.add_event(run_id, "stop", event))

    def deed(
        self, by: Actor, action: str, subject: str, after: Mapping[str, JsonValue] | None = None
    ) -> Event:
        """Record an audit entry with the time of this call; returns at once an event set when written."""
        at = datetime.now(UTC)
        return self._add(
            f"{action} by {by.name}",
            lambda: self._store.record(by, action, subject, after=after, at=at),
        )

    def close(self, limit_s: float) -> None:
        """Wait this long for pending records; those not written by then are in the log only."""
        thread = self._thread
        if thread is not None:
            thread.join(limit_s)
        self._closing.set()

    def _add(self, what: str, write: Callable[[], None]) -> Event:
        late = _Late(what, write)
        with self._lock:
            self._waiting.append(late)
            if self._thread is None:
                self._thread = Thread(target=self._run, name="late records", daemon=True)
                self._thread.start()
        return late.written

    def _next(self) -> _Late | None:
        with self._lock:
            if not self._waiting:
                self._thread = None
                return None
            return self._waiting[0]

    def _run(self) -> None:
        while (late := self._next()) is not None:
            try:
                late.write()
            except StoreUnavailable as error:
                log.error("The %s could not be recorded yet: %s", late.what, error)
                if self._closing.wait(PAUSE_S):
                    log.critical("Not recorded: %s", ", ".join(one.what for one in self._waiting))
                    return
                continue
            except Exception:  # a record that can never be written must not hold up those after it
                log.critical("Not recorded: %s", late.what, exc_info=True)
            else:
                late.written.set()
            self._waiting.popleft()
