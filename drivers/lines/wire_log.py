"""The wire log: everything that happened on the lines of a station during a run, as text.

One happening a line: tenths of a millisecond since the one before, the number of the line with a mark, bytes
in hexadecimal.  An asterisk after the mark: it was not the thread that carries out the run (a stop, a
watchdog's feeder).  What that thread read from its clock is in the log as well, for its decisions hang on it.
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
"""The line that readings of the clock are written under."""


@dataclass(frozen=True, slots=True)
class WireEvent:
    """One happening."""

    at_s: float
    """Since the log began."""
    line: int
    what: Entry
    data: bytes
    """Of `clock` the microseconds since the run began, in decimal."""
    own: bool
    """Whether the thread that carries out the run caused it."""


class WireLog:
    """Listens on lines until it is closed; one thread carries out the run, others may use the lines too."""

    def __init__(self, lines: Mapping[int, SerialLine], clock: Callable[[], float] | None = None) -> None:
        """:param lines: by the number that the log gives them; recording begins, for the calling thread"""
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
        """Listen no more."""
        for line in self._lines.values():
            line.recorder = None

    def note_clock(self, microseconds: int) -> None:
        """What the run's clock said."""
        self._write(_CLOCK, "clock", str(microseconds).encode())

    def take(self) -> str:
        """What was written since this was called last."""
        with self._lock:
            written, self._written = self._written, []
        return "".join(written)

    def _recorder(self, number: int) -> Recorder:
        return lambda what, data: self._write(number, what, data)

    def _write(self, line: int, what: Entry, data: bytes) -> None:
        with self._lock:
            own = get_ident() == self._owner
            # That nothing was there matters only if something came afterwards that nobody had asked for.
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
    """What a log says.  :raises ValueError: a line that is none of a log"""
    tick = 0
    for text in lines:
        match = _LINE.fullmatch(text.rstrip("\n"))
        if match is None:
            raise ValueError(f"{text.strip()!r} is no line of a wire log")
        passed, line, mark, other, data = match.groups()
        tick += int(passed)
        yield WireEvent(tick * _TICK_S, int(line), _ENTRIES[mark], bytes.fromhex(data), not other)
