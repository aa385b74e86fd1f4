"""Response times, measured at the line."""

from __future__ import annotations

import statistics
import time
from types import TracebackType
from typing import Self

from drivers.lines import Happening, SerialLine


class RoundTrips:
    """From the end of sending to the first received byte, for all requests within the block."""

    def __init__(self, line: SerialLine) -> None:
        self._line = line
        self._sent_s: float | None = None
        self._took_ms: list[float] = []

    def __enter__(self) -> Self:
        self._line.recorder = self._see
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._line.recorder = None

    @property
    def text(self) -> str:
        """The times in words; empty if there was no answer."""
        if not self._took_ms:
            return ""
        return (
            f"{len(self._took_ms)} replies, {statistics.median(self._took_ms):.2f} ms as a rule,"
            f" {max(self._took_ms):.2f} ms the slowest"
        )

    def _see(self, what: Happening, _data: bytes) -> None:
        if what == "tx":
            self._sent_s = time.monotonic()
        elif what == "rx" and self._sent_s is not None:
            self._took_ms.append((time.monotonic() - self._sent_s) * 1000)
            self._sent_s = None
