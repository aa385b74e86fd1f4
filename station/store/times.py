"""Times of events: the computer's clock is read only once per run."""

from __future__ import annotations

import time
from datetime import UTC, datetime


def now() -> datetime:
    """UTC, to the millisecond."""
    return datetime.fromtimestamp(now_ms() / 1000, UTC)


def now_ms() -> int:
    """Milliseconds since 1970, UTC."""
    return time.time_ns() // 1_000_000


def monotonic_ms() -> int:
    """Milliseconds since an arbitrary time; setting the clock does not change them."""
    return time.monotonic_ns() // 1_000_000


class RunTimes:
    """Times of the runs of this process: the clock at their creation plus monotonic time.

    A clock that jumps during a run therefore changes neither its duration nor the order of its times.
    """

    def __init__(self) -> None:
        self._begun: dict[int, int] = {}

    def begin(self, run: int, created_ms: int) -> None:
        """A run was created at this time by the clock."""
        self._begun[run] = created_ms - monotonic_ms()

    def now_ms(self, run: int) -> int:
        """The time of this run; the clock if another process created it."""
        begun = self._begun.get(run)
        return now_ms() if begun is None else begun + monotonic_ms()

    def now(self, run: int) -> datetime:
        """The same, UTC."""
        return datetime.fromtimestamp(self.now_ms(run) / 1000, UTC)

    def end(self, run: int) -> None:
        """The run has ended."""
        self._begun.pop(run, None)
