"""A wire log played back to the drivers that made it: same requests, same answers."""

from __future__ import annotations

import time
from collections.abc import Iterable

from drivers import errors
from drivers.errors import DeviceError
from drivers.lines.ports import Opener, Port
from drivers.lines.url import NetAddress, SerialAddress
from drivers.lines.wire_log import Entry, WireEvent

_TRANSACTION = slice(0, 2)
"""Number of the request in a Modbus TCP frame, assigned by the sender."""


class Departed(Exception):
    """The drivers act differently than when the log was made."""


class Playback:
    """The events of the thread that carried out the run, in order."""

    def __init__(self, events: Iterable[WireEvent]) -> None:
        self._events = [event for event in events if event.own]
        self._next = 0

    def opener(self, line: int, *, numbered: bool) -> Opener:
        """Opens a port in place of the real one.

        :param numbered: whether frames begin with a number assigned by the sender, as in Modbus TCP
        """

        def open_port(address: SerialAddress | NetAddress, xonxoff: bool) -> Port:
            if (event := self.taken(line, "refused")) is not None:
                kind, _, text = event.data.decode().partition(" ")
                raise getattr(errors, kind, DeviceError)(text)
            return _PlayedPort(self, line, numbered)

        return open_port

    def clock(self) -> float:
        """The next time of the run's clock, in seconds since the run began. :raises Departed:"""
        event = self.taken(0, "clock")
        if event is None:
            raise self.departed("looks at its clock")
        return int(event.data) / 1e6

    def taken(self, line: int, what: Entry) -> WireEvent | None:
        """The next event, if it is this one."""
        if self._next < len(self._events):
            event = self._events[self._next]
            if (event.line, event.what) == (line, what):
                self._next += 1
                return event
        return None

    def departed(self, does: str) -> Departed:
        """The error for an action that differs from the next event."""
        if self._next == len(self._events):
            return Departed(f"The wire log ends here, and the station {does}.")
        event = self._events[self._next]
        return Departed(
            f"At {event.at_s:.4f} s of the wire log (entry {self._next + 1}: line {event.line}, {event.what}"
            f" {event.data.hex(' ')}) the station {does}."
        )

    @property
    def is_over(self) -> bool:
        """Whether all events have been played."""
        return self._next == len(self._events)


class _PlayedPort:
    def __init__(self, playback: Playback, line: int, numbered: bool) -> None:
        self._playback = playback
        self._line = line
        self._numbered = numbered
        self._numbers = (b"", b"")

    def write(self, data: bytes) -> None:
        while self._playback.taken(self._line, "nothing"):
            pass  # its wait ended earlier than this one
        self._break_if_it_did()
        event = self._playback.taken(self._line, "tx")
        if event is None:
            raise self._playback.departed(f"sends {data.hex(' ')}")
        if self._numbered:
            self._numbers = event.data[_TRANSACTION], data[_TRANSACTION]
        if self._renumbered(event.data) != data:
            raise Departed(f"The station sends {data.hex(' ')} in place of {event.data.hex(' ')}.")

    def read_some(self, deadline_s: float) -> bytes:
        self._break_if_it_did()
        if self._playback.taken(self._line, "nothing"):
            return b""
        if (event := self._playback.taken(self._line, "rx")) is not None:
            return self._renumbered(event.data)
        time.sleep(max(0.0, deadline_s - time.monotonic()))
        return b""

    def interrupt(self) -> None:
        """No thread waits."""

    def close(self) -> None:
        """There is nothing to release."""

    def _break_if_it_did(self) -> None:
        if (event := self._playback.taken(self._line, "broken")) is not None:
            raise OSError(event.data.decode())

    def _renumbered(self, data: bytes) -> bytes:
        then, now = self._numbers
        return now + data[2:] if self._numbered and data[_TRANSACTION] == then else data
