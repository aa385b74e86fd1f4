"""One diagnosis and one scan of the catalogue, timed on a random machine with backlash."""

from __future__ import annotations

from typing import Any

from station.diagnosis import Scan, diagnose, traced
from station.effects import five_bar_catalogue
from station.five_bar import Robot
from station.studies.bench.timing import time_ms
from station.studies.confusion import draw

SEARCHED = ("gear_cyclic", "scale_cyclic")
"""Effects whose frequency is unknown; their search is part of the diagnosis and not of the scan's figure."""


def measure(seconds: float) -> dict[str, Any]:
    """{scan_ms, diagnose_ms}: 110 readings, and 40 fresh ones for the diagnosis."""
    robot = Robot.default()
    drawn = draw(robot, ("backlash",), seed=1)
    base = traced(robot, drawn.sequence).base
    effects = [effect for effect in five_bar_catalogue() if effect.id not in SEARCHED]
    return {
        "scan_ms": time_ms(lambda: Scan(base).candidates(effects), seconds=seconds),
        "diagnose_ms": time_ms(lambda: diagnose(robot, drawn.sequence, drawn.fresh), seconds=seconds),
    }
