"""The order in which threads use a line."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from itertools import count
from threading import Condition

Gate = Callable[[], AbstractContextManager[None]]
"""Context in which a frame is sent, so that no other decision falls between decision and frame."""


class Lane:
    """A lock in which urgent callers overtake all others; ordinary ones wait while an urgent one waits.

    Ordinary callers are served in the order of arrival. Without that, a thread that uses a line continuously
    would take it again before a waiting thread wakes up, and a watchdog would not be fed.
    """

    def __init__(self) -> None:
        self._changed = Condition()
        self._busy = False
        self._urgent_waiting = 0
        self._tickets = count()
        self._queue: list[int] = []

    @property
    def urgent_waiting(self) -> bool:
        """Whether the holder should release it."""
        return self._urgent_waiting > 0

    @contextmanager
    def hold(self, *, urgent: bool) -> Iterator[None]:
        with self._changed:
            if urgent:
                self._urgent_waiting += 1
                self._changed.wait_for(lambda: not self._busy)
                self._urgent_waiting -= 1
            else:
                ticket = next(self._tickets)
                self._queue.append(ticket)
                self._changed.wait_for(lambda: self._may_go(ticket))
                self._queue.remove(ticket)
            self._busy = True
        try:
            yield
        finally:
            with self._changed:
                self._busy = False
                self._changed.notify_all()

    def _may_go(self, ticket: int) -> bool:
        return not self._busy and not self._urgent_waiting and self._queue[0] == ticket
