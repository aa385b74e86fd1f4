"""Events of the station for its listeners: the page's live feed, the terminal's progress."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock
from typing import Literal

from station.records import (
    CalibrationSummary,
    DeviceView,
    Interlock,
    MachineView,
    ResidualOfReading,
    RetractView,
    RunBrief,
    RunReading,
    SequenceView,
)

log = logging.getLogger(__name__)

EventType = Literal[
    "run", "walk", "reading", "residuals", "machine", "device", "interlock", "retract", "ended"
]


EventData = (
    RunBrief
    | SequenceView
    | RunReading
    | list[ResidualOfReading]
    | MachineView
    | DeviceView
    | tuple[Interlock, ...]
    | RetractView
    | CalibrationSummary
    | None
)


@dataclass(frozen=True, slots=True)
class LiveEvent:
    """One event."""

    type: EventType
    data: EventData


Listener = Callable[[LiveEvent], None]


class Listeners:
    """Calls all subscribers in the thread that publishes: a listener must be quick."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._listeners: list[Listener] = []

    def subscribe(self, listener: Listener) -> Callable[[], None]:
        """Returns the function that unsubscribes; it may be called twice."""
        with self._lock:
            self._listeners.append(listener)

        def unsubscribe() -> None:
            with self._lock:
                if listener in self._listeners:
                    self._listeners.remove(listener)

        return unsubscribe

    def publish(self, type: EventType, data: EventData) -> None:
        """Call all listeners; one that fails is dropped: the page must not disturb the measurement."""
        event = LiveEvent(type, data)
        with self._lock:
            listeners = tuple(self._listeners)
        for listener in listeners:
            try:
                listener(event)
            except Exception:  # external code, called in the worker's thread
                log.exception("A listener failed and is dropped")
                with self._lock:
                    if listener in self._listeners:
                        self._listeners.remove(listener)
