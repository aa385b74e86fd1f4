"""The wire log: everything that happened on the lines of a station during a run, as text.

One event per line: tenths of a millisecond since the previous one, the number of the wire with a mark, bytes
in hexadecimal. An asterisk after the mark: it was another thread than that of the run (a stop, a watchdog's
feeder). The times that the run's thread read from its clock are in the log as well, since its decisions
depend on them.
"""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from threading import Lock, get_ident
from typing import Literal

from drivers.lines.serial import Happening, Recorder, SerialLine

Entry = Happening | Literal["clock"]
_MARKS: dict[Entry, str] = {
    "tx": ">",
    "rx": "<",
    "nothing": ".",
    "broken": "!",
    "refused": "x",
    "clock": "c",
}
_ENTRIES = {mark: entry for entry, mark in _MARKS.items()}
_LINE = re.compile(r"(\d+) (\d+)([><.!xc])(\*?) ((?:[0-9a-f]{2})*)")
_TICK_S = 1e-4
_CLOCK = 0
"""Line number for readings of the clock."""


@dataclass(frozen=True, slots=True)
class WireEvent:
    """One event."""

    at_s: float
    """Time since the log began."""
    line: int
    what: Entry
    data: bytes
    """For `clock`, the microseconds since the run began, in decimal."""
    own: bool
    """Whether the thread of the run caused it."""


class WireLog:
    """Records lines until it is closed; one thread carries out the run, others may use the lines too."""

    def __init__(self, lines: Mapping[int, SerialLine], clock: Callable[[], float] | None = None) -> None:
        """:param lines: by their number in the log; recording begins, for the calling thread"""
        self._lines = lines
        self._clock = clock or time.monotonic
        self._owner = get_ident()
        self._lock = Lock()
        self._last_tick = 0
        self._began_s = self._clock()
        self._glances: Counter[int] = Counter()
        self._written: list[str] = []
        for number, line in lines.items():
            line.recorder = self._recorder(number)

    def close(self) -> None:
        """End recording."""
        for line in self._lines.values():
            line.recorder = None

    def note_clock(self, microseconds: int) -> None:
        """Record a time of the run's clock."""
        self._write(_CLOCK, "clock", str(microseconds).encode())

    def take(self) -> str:
        """Text written since the last call."""
        with self._lock:
            written, self._written = self._written, []
        return "".join(written)

    def _recorder(self, number: int) -> Recorder:
        return lambda what, data: self._write(number, what, data)

    def _write(self, line: int, what: Entry, data: bytes) -> None:
        with self._lock:
            own = get_ident() == self._owner
            # An empty read is relevant only if bytes arrived afterwards without a request.
            if what == "nothing":
                self._glances[line] += own
                return
            if own and what in ("tx", "rx"):
                for _ in range(self._glances.pop(line, 0) if what == "rx" else 0):
                    self._put(line, "nothing", b"", own)
                self._glances.pop(line, None)
            self._put(line, what, data, own)

    def _put(self, line: int, what: Entry, data: bytes, own: bool) -> None:
        tick = round((self._clock() - self._began_s) / _TICK_S)
        passed, self._last_tick = tick - self._last_tick, tick
        self._written.append(f"{passed} {line}{_MARKS[what]}{'' if own else '*'} {data.hex()}\n")


def wire_events(lines: Iterable[str]) -> Iterator[WireEvent]:
    """The events of a log. :raises ValueError: a line is not of a log"""
    tick = 0
    for text in lines:
        match = _LINE.fullmatch(text.rstrip("\n"))
        if match is None:
            raise ValueError(f"{text.strip()!r} is no line of a wire log")
        passed, line, mark, other, data = match.groups()
        tick += int(passed)
        yield WireEvent(tick * _TICK_S, int(line), _ENTRIES[mark], bytes.fromhex(data), not other)
