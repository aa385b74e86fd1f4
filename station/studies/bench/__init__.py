"""Benchmarks: what each figure measures is said beside it."""

from __future__ import annotations

from station.studies.bench.served import SETTINGS, serving
from station.studies.bench.service import ask, connected, run_times
from station.studies.bench.study import bench

__all__ = [
    "SETTINGS",
    "ask",
    "bench",
    "connected",
    "run_times",
    "serving",
]
