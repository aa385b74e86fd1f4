"""Delivery of events to other systems: webhooks, MQTT and folders, each in order, at least once."""

from __future__ import annotations

from station.outbox.alarms import Alarms
from station.outbox.courier import Courier, couriers
from station.outbox.folder import Folder
from station.outbox.receiver import Receiver, Refused

__all__ = [
    "Alarms",
    "Courier",
    "Folder",
    "Receiver",
    "Refused",
    "couriers",
]
