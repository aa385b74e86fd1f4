"""Who may use a line next."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from itertools import count
from threading import Condition

Gate = Callable[[], AbstractContextManager[None]]
"""What a frame is sent inside of, so that nothing decided elsewhere comes between decision and frame."""


class Lane:
    """A lock whose urgent callers pass all that wait; ordinary ones wait while an urgent one does.

    Ordinary callers go in the order in which they came.  Without that, whoever works with a line all the
    time takes it again before one that waits has woken up, and a watchdog is not fed.
    """

    def __init__(self) -> None:
        self._changed = Condition()
        self._busy = False
        self._urgent_waiting = 0
        self._tickets = count()
        self._queue: list[int] = []

    @property
    def urgent_waiting(self) -> bool:
        """Whether the holder should give way."""
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
