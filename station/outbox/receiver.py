"""What a receiver is: something that takes one event after the other."""

from __future__ import annotations

from typing import Protocol

from pydantic_core import to_json

from station.records import Event


class Refused(Exception):
    """The receiver will never take this event; says why.  Every other exception means: try again."""


class Receiver(Protocol):
    """Of one `[[outbox....]]`; used by one thread."""

    @property
    def name(self) -> str:
        """Under which its deliveries are kept: another name is another receiver."""

    @property
    def events(self) -> tuple[str, ...]:
        """Types of event that it is told of."""

    def start(self) -> None:
        """Say that the station lives, where the receiver wants to know; never waits, never fails."""

    def deliver(self, event: Event) -> str:
        """Returns what the receiver said.

        :raises Refused: it will never take it
        :raises OSError: or anything else: it could not be reached, or said that it failed
        """

    def close(self) -> None:
        """Let go of what is open."""


def body_of(event: Event) -> bytes:
    """The payload that webhooks and topics carry: `{type, timestamp, data}` as Standard Webhooks has it."""
    return to_json({"type": event.type, "timestamp": event.at, "data": event.data})
