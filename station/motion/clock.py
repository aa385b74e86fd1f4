"""The clock of a run, which its decisions and times depend on, recorded for replay."""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Event
from typing import Protocol


class Clock(Protocol):
    """The clock of one run."""

    def now(self) -> float:
        """Seconds since the run began."""
        ...

    def wait(self, cancel: Event, seconds: float) -> bool:
        """Whether the run was asked to end within this time."""
        ...


class RunClock:
    """Real time."""

    def __init__(self, elapsed_s: float = 0.0, note: Callable[[int], None] = lambda _: None) -> None:
        """:param elapsed_s: time since the run began; :param note: receives each time that is read,
        microseconds
        """
        self._started_s = time.monotonic() - elapsed_s
        self._note = note

    def now(self) -> float:
        microseconds = round((time.monotonic() - self._started_s) * 1e6)
        self._note(microseconds)
        return microseconds / 1e6

    def wait(self, cancel: Event, seconds: float) -> bool:
        return cancel.wait(seconds)


class PlayedClock:
    """The recorded times of a run, without the waiting."""

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now

    def now(self) -> float:
        return self._now()

    def wait(self, cancel: Event, seconds: float) -> bool:
        return cancel.is_set()
