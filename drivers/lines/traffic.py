"""The amount of data on a line since it was made, and the times of its replies."""

from __future__ import annotations

import time


class Traffic:
    """Only counts; reading them never waits for the line.

    A round trip is the time from the end of sending to the first received byte.
    """

    def __init__(self) -> None:
        self._sent_at_s: float | None = None
        self.requests = 0
        self.replies = 0
        self.broken = 0
        """Number of failures of the open line, and of failed attempts to open it."""
        self.round_trips_s = 0.0
        """Sum over all replies."""
        self.last_round_trip_s: float | None = None
        self.stop_sent_at_s: dict[int, float] = {}
        """By unit, time of the clock at which its last non-repeated stop frame was sent."""

    def note_stop(self, unit: int) -> None:
        """The first frame of a stop has been sent."""
        self.stop_sent_at_s[unit] = time.monotonic()

    def note(self, what: str) -> None:
        """Count an event on the line.

        :param what: a `Happening`
        """
        match what:
            case "tx":
                self.requests += 1
                self._sent_at_s = time.monotonic()
            case "rx" if self._sent_at_s is not None:
                took_s, self._sent_at_s = time.monotonic() - self._sent_at_s, None
                self.replies += 1
                self.round_trips_s += took_s
                self.last_round_trip_s = took_s
            case "broken" | "refused":
                self.broken += 1
                self._sent_at_s = None
