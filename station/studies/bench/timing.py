"""Repeated timing of one call."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence

Figure = dict[str, float]
"""{median, min, n}"""


def figure(values: Sequence[float]) -> Figure:
    """Median, smallest and number of values."""
    return {"median": statistics.median(values), "min": min(values), "n": len(values)}


def time_ms(call: Callable[[], object], *, seconds: float = 1.0, most: int = 1000) -> Figure:
    """Milliseconds of one call, for `seconds` but at least five times; a first call is not counted."""
    call()
    taken: list[float] = []
    until = time.perf_counter() + seconds
    while len(taken) < 5 or (len(taken) < most and time.perf_counter() < until):
        begun = time.perf_counter()
        call()
        taken.append((time.perf_counter() - begun) * 1e3)
    return figure(taken)
