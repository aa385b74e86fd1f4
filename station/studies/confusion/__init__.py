"""The diagnosis judged on random emulated machines."""

from __future__ import annotations

from station.studies.confusion.machines import draw
from station.studies.confusion.matrix import KINDS, figures, markdown, run

__all__ = [
    "KINDS",
    "draw",
    "figures",
    "markdown",
    "run",
]
