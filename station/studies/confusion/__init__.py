"""The diagnosis judged on random emulated machines."""

from __future__ import annotations

from station.studies.confusion.kinds import KINDS
from station.studies.confusion.machines import draw, of_usual_size
from station.studies.confusion.matrix import figures, label, run
from station.studies.confusion.page import markdown

__all__ = [
    "KINDS",
    "draw",
    "figures",
    "label",
    "markdown",
    "of_usual_size",
    "run",
]
