"""The running station: the orchestrator and everything that is opened and closed with it."""

from __future__ import annotations

from station.service.challenges import KINDS
from station.service.entrance import check_entrance, listens_on_loopback
from station.service.orchestrator import LiveEvent, Orchestrator, Submitted
from station.service.procedures import follow_procedure
from station.service.replaying import Replayed, replay
from station.service.runtime import Runtime, holding
from station.service.timer import Timer
from station.service.training import TrainingDesk

__all__ = [
    "KINDS",
    "LiveEvent",
    "Orchestrator",
    "Replayed",
    "Runtime",
    "Submitted",
    "Timer",
    "TrainingDesk",
    "check_entrance",
    "follow_procedure",
    "holding",
    "listens_on_loopback",
    "replay",
]
