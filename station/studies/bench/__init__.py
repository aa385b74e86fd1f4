"""Benchmarks: what each figure measures is said beside it."""

from __future__ import annotations

from station.studies.bench.served import serving
from station.studies.bench.service import connected
from station.studies.bench.study import bench

__all__ = [
    "bench",
    "connected",
    "serving",
]
