"""What the pages of a long history ask for, over HTTP."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import closing
from http.client import HTTPConnection
from pathlib import Path
from statistics import median

from station.studies.bench import connected, serving

ANSWERS = (
    "calibrations", "calibrations?state=failed", "calibrations?search=R12",
    "calibrations?search=R123&state=failed",
    "calibrations?plan=diagnostic", "calibrations?order=serial", "calibrations?since=2027-06-01T00:00:00Z",
    "calibrations?until=2027-06-01T00:00:00Z", "calibrations/count", "calibrations/count?state=succeeded",
    "calibrations/count?search=R12&state=failed", "calibrations/count?search=R1&state=aborted",
    "calibrations/count?search=R&state=aborted", "calibrations/count?since=2027-06-01T00:00:00Z", "trend",
    "robots/R1/trend", "quality", "quality?robot_serial=R1",
)  # fmt: skip


def answered(home: Path, times: int) -> Iterator[tuple[str, float, float]]:
    """Each address with the median time of its answer by the clock and of all processors, ms."""
    with serving(home) as port, closing(connected(port)) as http:
        (process,) = _children()
        for path in ANSWERS:
            _get(http, path)  # what is read for the first time comes from the disk
            by_clock, of_processor = [], []
            for _ in range(times):
                used_ms, began = _used_ms(process), time.perf_counter()
                _get(http, path)
                by_clock.append((time.perf_counter() - began) * 1e3)
                of_processor.append(_used_ms(process) - used_ms)
            yield path, median(by_clock), median(of_processor)


def _get(http: HTTPConnection, path: str) -> None:
    http.request("GET", f"/api/v1/{path}")
    answer = http.getresponse()
    content = answer.read()
    if answer.status != 200:
        raise RuntimeError(f"{path} answers {answer.status}: {content.decode()}")


def _children() -> list[int]:
    own = os.getpid()
    return [int(pid) for pid in Path(f"/proc/{own}/task/{own}/children").read_text().split()]


def _used_ms(process: int) -> float:
    """By all threads of a process, on Linux."""
    tasks = Path(f"/proc/{process}/task").iterdir()
    return sum(int((task / "schedstat").read_text().split()[0]) for task in tasks) / 1e6
