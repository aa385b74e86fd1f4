"""What the station tells others: events, and how far they were delivered."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import JsonValue

from station.records.record import Record

EventType = Literal["run.started", "run.ended", "alarm", "station.started", "station.stopped"]
DeliveryState = Literal["waiting", "delivered", "refused", "expired"]


class Event(Record):
    """Something that happened; `n` rises from 1 without gaps, `uid` is the same at every delivery."""

    n: int
    uid: str
    type: EventType
    at: datetime
    data: dict[str, JsonValue]


class Delivery(Record):
    """One event on its way to one receiver."""

    id: int
    receiver: str
    event: int
    uid: str
    type: EventType
    state: DeliveryState
    tries: int
    detail: str
    """What the receiver said last, or why it was given up."""
    next_at: datetime | None
    """Of the next try, while it waits."""
    ended_at: datetime | None


class Backlog(Record):
    """What waits for one receiver."""

    receiver: str
    count: int
    oldest_at: datetime
    """When the oldest of these events happened."""
