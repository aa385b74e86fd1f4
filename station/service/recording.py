"""The wire log of one run, from the opening of its lines to its standstill, as compressed pieces."""

from __future__ import annotations

import zlib

from drivers.lines import SerialLine, WireLog, line_of
from station.motion import Clock, Devices, RunClock
from station.records import WireHeader
from station.settings import Settings

SCALE, SERVO = 1, 2
"""Numbers of the lines in the log."""


def lines_of(devices: Devices) -> dict[int, SerialLine]:
    """The lines by their numbers; both drives share one. Empty where devices have no lines, as in tests."""
    found = {SCALE: line_of(devices.scale), SERVO: line_of(devices.axes[0])}
    return {number: line for number, line in found.items() if line is not None}


class Recording:
    """Created by the thread that carries out the run, which also calls `take` and `end`."""

    def __init__(self, devices: Devices, settings: Settings) -> None:
        self._lines = lines_of(devices)
        header = WireHeader(
            scale=settings.scale.flat() if settings.scale else {},
            servo=settings.servo.flat() if settings.servo else {},
            limits=settings.limits.model_dump(mode="json"),
            interlocks=settings.interlocks.model_dump(mode="json", exclude_none=True),
            speed=devices.speed,
        )
        self._header_text = header.model_dump_json() + "\n"
        self._pack = zlib.compressobj(9)
        self._log: WireLog | None = None

    def begin(self, elapsed_s: float) -> Clock:
        """Start recording; returns the clock of the run."""
        if not self._lines:
            return RunClock(elapsed_s)
        self._log = WireLog(self._lines)
        return RunClock(elapsed_s, self._log.note_clock)

    def take(self) -> bytes:
        """A piece, to be stored after those before it; it is readable although the log continues."""
        if self._log is None:
            return b""
        first, self._header_text = self._header_text, ""
        return self._pack.compress((first + self._log.take()).encode()) + self._pack.flush(zlib.Z_SYNC_FLUSH)

    def end(self) -> bytes:
        """End recording; returns the last piece."""
        if self._log is None:
            return b""
        self._log.close()
        return self.take() + self._pack.flush()
