"""The cause that ended a motion, in the record of its run and at the interlock."""

from __future__ import annotations

import logging
import time

from pydantic import JsonValue

from drivers.errors import DeviceError
from station.errors import StoreUnavailable
from station.motion import Machine, Tripped
from station.service.ending import Ending
from station.service.run import Run
from station.store import Store

log = logging.getLogger(__name__)


class Trips:
    """Trips of one machine."""

    def __init__(self, machine: Machine, store: Store) -> None:
        self._machine, self._store = machine, store

    def tripped(self, run: Run, error: Exception) -> Tripped | None:
        """The interlock that ended a run; None if a limit or the input did, or nothing had moved."""
        if isinstance(error, DeviceError) and run.has_moved:
            return self._machine.trip_by(error, str(error))
        return error if isinstance(error, Tripped) else None

    def record(self, run: Run, ending: Ending, failed_at_s: float) -> None:
        """Record the cause that ended a motion, and the times from its detection to the stops and to the
        confirmed standstill of both axes.

        :param failed_at_s: time by the monotonic clock, if no interlock detected it
        """
        reason = ending.reason
        if not run.has_moved or reason is None or reason.code != "step_failed":
            return
        data: dict[str, JsonValue] = {
            "text": reason.text,
            "standstill_after_ms": round((time.monotonic() - failed_at_s) * 1000, 1),
        }
        if ending.tripped is not None:
            trip = self._machine.came_to_rest(run.id, ending.tripped)
            data |= {
                "interlock": ending.tripped.interlock,
                "stop_frame_after_ms": trip.stop_frame_ms,
                "standstill_after_ms": trip.standstill_ms,
            }
        try:
            self._store.add_event(run.id, "trip", data)
        except StoreUnavailable:
            log.exception("What stopped run %d could not be recorded as an event", run.id)
