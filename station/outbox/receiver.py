"""The interface of a receiver, which accepts one event after the other."""

from __future__ import annotations

from typing import Protocol

from pydantic_core import to_json

from station.records import Event


class Refused(Exception):
    """The receiver will never accept this event; with the reason. Every other exception means: try again."""


class Receiver(Protocol):
    """The receiver of one `[[outbox....]]`; used by one thread."""

    @property
    def name(self) -> str:
        """The name under which its deliveries are stored: another name is another receiver."""

    @property
    def events(self) -> tuple[str, ...]:
        """Types of event for this receiver."""

    def report_running(self) -> None:
        """Report that the station is running, if the receiver supports it.

        Called at the start and at intervals; never waits, never fails.
        """

    def deliver(self, event: Event) -> str:
        """Deliver an event; returns the answer of the receiver.

        :raises Refused: it will never accept it
        :raises OSError: or any other error: it could not be reached, or reported a failure
        """

    def close(self) -> None:
        """Release open resources."""


def body_of(event: Event) -> bytes:
    """The payload of webhooks and topics: `{type, timestamp, data}` as in Standard Webhooks."""
    return to_json({"type": event.type, "timestamp": event.at, "data": event.data})
