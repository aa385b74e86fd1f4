"""The diagnosis judged on random emulated machines."""

from __future__ import annotations

from station.studies.confusion.machines import draw
from station.studies.confusion.matrix import KINDS, markdown, run

__all__ = [
    "KINDS",
    "draw",
    "markdown",
    "run",
]
