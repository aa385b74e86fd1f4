"""The plant's receiver of events: accepts them, refuses them, fails in between."""

from __future__ import annotations

from random import Random

from station.records import Event
from station.simulation.scheduler import Scheduler


class Receiver:
    """Another computer: its accepted events remain, whatever happens to the station."""

    def __init__(self, scheduler: Scheduler, random: Random, name: str) -> None:
        self._scheduler, self._random = scheduler, random
        self.name = name
        self.events: tuple[str, ...] = ("run.ended",)
        self.taken: list[tuple[int, str]] = []
        """Number of each event and uid of its run, in the order they came."""
        self.fails = 0.0
        """Share of the deliveries that fail."""

    def report_running(self) -> None:
        """Nothing to do."""

    def deliver(self, event: Event) -> str:
        """As `station.outbox.Receiver.deliver`."""
        self._scheduler.wait(seconds=self._random.uniform(0.001, 0.2))
        spoiled = self._random.random() < self.fails
        if spoiled and self._random.random() < 0.5:
            raise ConnectionError("500 Internal Server Error")
        self.taken.append((event.n, str(event.data.get("uid"))))
        if spoiled:
            raise TimeoutError("it took the event, and its answer was lost")
        return "200"

    def close(self) -> None:
        """Nothing to close."""
