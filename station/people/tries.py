"""Failed sign-ins: after a few, the next ones with that name or from that address have to wait.

Only sign-ins are counted. Requests of signed-in users, and every stop, are not affected.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from threading import Lock

from station.errors import TooManyTries

FREE = 5
"""Number of failures without a waiting time."""
WINDOW_S = 60.0
MOST_KEPT = 10_000
"""Number of names and addresses; beyond it the oldest are discarded."""


class Tries:
    """Thread safe."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._lock = Lock()
        self._failures: dict[str, deque[float]] = {}

    def check(self, *who: str) -> None:
        """:raises TooManyTries: one of these has failed too often within the last minute."""
        now = self._clock()
        with self._lock:
            wait_s = max((self._wait_s(name, now) for name in who), default=0.0)
        if wait_s > 0:
            raise TooManyTries(wait_s)

    def failed(self, *who: str) -> None:
        """Count a failure."""
        with self._lock:
            for name in who:
                self._failures.setdefault(name, deque(maxlen=FREE)).append(self._clock())
            while len(self._failures) > MOST_KEPT:
                del self._failures[next(iter(self._failures))]

    def succeeded(self, who: str) -> None:
        """Forget the failures of this one."""
        with self._lock:
            self._failures.pop(who, None)

    def _wait_s(self, name: str, now: float) -> float:
        failures = self._failures.get(name)
        if failures is None or len(failures) < FREE:
            return 0.0
        return failures[0] + WINDOW_S - now
