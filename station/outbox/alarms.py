"""Alarms: a lost or faulty device, and an interlock that opens, become events."""

from __future__ import annotations

import logging

from station.errors import StoreUnavailable
from station.records import DeviceView, Interlock
from station.store import Store

log = logging.getLogger(__name__)


class Alarms:
    """Listens to the live events of the station; each trouble is reported once, when it begins."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._devices: set[str] = set()
        self._holding: set[str] = set()

    def device(self, view: DeviceView) -> None:
        """The state of a device has changed."""
        if view.state not in ("lost", "fault"):
            self._devices.discard(view.name)
        elif view.name not in self._devices:
            self._devices.add(view.name)
            self._tell(view.name, view.text or view.state)

    def interlocks(self, all: tuple[Interlock, ...]) -> None:
        """An interlock has changed."""
        for one in all:
            if one.ok:
                self._holding.add(one.id)
            elif one.id in self._holding:  # at the start none holds until the devices were queried
                self._holding.remove(one.id)
                self._tell(one.id, f"{one.text}: {one.detail}".rstrip(": "))

    def _tell(self, source: str, text: str) -> None:
        try:
            self._store.announce("alarm", {"source": source, "text": text})
        except StoreUnavailable:
            log.exception("The alarm of %s (%s) could not be recorded", source, text)
