"""Who may use a line next."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from threading import Condition

Gate = Callable[[], AbstractContextManager[None]]
"""What a frame is sent inside of, so that nothing decided elsewhere comes between decision and frame."""


class Lane:
    """A lock whose urgent callers pass all that wait; ordinary ones wait while an urgent one does."""

    def __init__(self) -> None:
        self._changed = Condition()
        self._busy = False
        self._urgent_waiting = 0

    @property
    def urgent_waiting(self) -> bool:
        """Whether the holder should give way."""
        return self._urgent_waiting > 0

    @contextmanager
    def hold(self, *, urgent: bool) -> Iterator[None]:
        with self._changed:
            self._urgent_waiting += urgent
            self._changed.wait_for(lambda: not self._busy and (urgent or not self._urgent_waiting))
            self._urgent_waiting -= urgent
            self._busy = True
        try:
            yield
        finally:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
