"""Events for other systems, and their delivery."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import JsonValue

from station.records.record import Record

EventType = Literal["run.started", "run.ended", "alarm", "station.started", "station.stopped"]
DeliveryState = Literal["waiting", "delivered", "refused", "expired"]


class Event(Record):
    """An event; `n` increases from 1, `uid` is the same at every delivery."""

    n: int
    uid: str
    type: EventType
    at: datetime
    data: dict[str, JsonValue]


class Delivery(Record):
    """The delivery of one event to one receiver."""

    id: int
    receiver: str
    event: int
    uid: str
    type: EventType
    state: DeliveryState
    tries: int
    detail: str
    """Last answer of the receiver, or why the delivery was given up."""
    next_at: datetime | None
    """Time of the next attempt, while it is pending."""
    ended_at: datetime | None


class Backlog(Record):
    """Pending deliveries of one receiver."""

    receiver: str
    count: int
    oldest_at: datetime
    """Time of the oldest of these events."""
