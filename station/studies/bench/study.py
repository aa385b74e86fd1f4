"""The whole benchmark as one JSON object (`station bench --json`)."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from rich.console import Console

from station import __version__
from station.studies.bench import service, solvers

SECONDS = 2.0
HISTORIES = {"history_100k_ms": 100_000, "history_1m_ms": 1_000_000}
QUICK_HISTORIES = {"history_100k_ms": 1_000, "history_1m_ms": 10_000}
TARGETS = {
    "identify_4x60_ms": 0.5,
    "identify_13x60_ms": 2.0,
    "scan_ms": 5.0,
    "diagnose_ms": 100.0,
    "run_http_ms": 20.0,
    "bytes_per_run": 1500.0,
    "history_100k_ms": 10.0,
    "history_1m_ms": 10.0,
}
"""Of the medians (peers' figures to beat)."""
PACKAGES = ("numpy", "scipy", "fastapi", "uvicorn", "sqlite-utils", "lmfit")


def bench(console: Console, *, quick: bool = False) -> dict[str, Any]:
    """Each figure {median, min, n}; null where it is not measured."""
    content: dict[str, Any] = {"schema": "station.bench/1", **dict.fromkeys(TARGETS)}
    with console.status("Identification") as status:
        solved = solvers.measured_alone(0.2 if quick else SECONDS)
        content |= solved["ours"]
        status.update("Runs over HTTP")
        content |= service.runs()
        pages = {}
        for name, count in (QUICK_HISTORIES if quick else HISTORIES).items():
            status.update(f"History of {count:,} runs")
            found = service.history(count)
            content[name] = found["ms"]
            pages[name] = {"runs": count, "page_bytes": found["page_bytes"]}
    return content | {
        "history": pages,
        "agreement": solved["agreement"],
        "targets": TARGETS,
        "peers": solved["peers"],
        "machine": machine(),
        "versions": versions(),
    }


def machine() -> dict[str, Any]:
    """What it was measured on."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "load_1min": os.getloadavg()[0],
        "system": platform.system(),
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "")


def versions() -> dict[str, str]:
    """Of what takes part, where installed."""
    found = {"station": __version__, "python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
