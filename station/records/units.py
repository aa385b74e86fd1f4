"""Units of foreign files: their spellings, and their conversion to those of the contract."""

from __future__ import annotations

import math
import re
from typing import Literal

Unit = Literal[
    "deg", "rad", "mrad", "gon", "rev", "mm", "m", "cm", "um", "in", "s", "ms", "us", "min", "h", "C", "kg",
    "g", "counts",
]  # fmt: skip
TO_CONTRACT: dict[str, dict[str, float]] = {
    "deg": {"deg": 1.0, "rad": 180.0 / math.pi, "mrad": 0.18 / math.pi, "gon": 0.9, "rev": 360.0},
    "mm": {"mm": 1.0, "m": 1e3, "cm": 10.0, "um": 1e-3, "in": 25.4},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0, "h": 3600.0},
    "c": {"C": 1.0},
    "kg": {"kg": 1.0, "g": 1e-3},
}
"""Unit in a column's name -> factor for each unit that a file may have."""
_WRITTEN: dict[str, Unit] = {
    "deg": "deg", "degree": "deg", "degrees": "deg", "°": "deg", "grad": "deg",
    "degré": "deg", "degrés": "deg",
    "rad": "rad", "radian": "rad", "radians": "rad", "mrad": "mrad", "gon": "gon", "rev": "rev",
    "mm": "mm", "m": "m", "meter": "m", "metre": "m", "cm": "cm", "um": "um", "µm": "um", "μm": "um",
    "in": "in", "inch": "in", "s": "s", "sec": "s", "ms": "ms", "us": "us", "µs": "us", "min": "min",
    "h": "h", "c": "C", "°c": "C", "degc": "C", "kg": "kg", "g": "g", "counts": "counts", "pulses": "counts",
}  # fmt: skip
_IN_BRACKETS = re.compile(r"[\[(]\s*([^\])]+?)\s*[\])]")
_AT_THE_END = re.compile(
    r"[_ ,/]\s*(deg|degrees|rad|radians|mrad|gon|mm|cm|m|um|in|inch|s|ms|us)$", re.IGNORECASE
)


def unit_in(text: str) -> Unit | Literal[""]:
    """The unit in a cell, alone or in brackets; empty if there is none."""
    return _WRITTEN.get(text.strip("[](){} ").lower(), "")


def unit_in_name(name: str) -> Unit | Literal[""]:
    """The unit in a column's name, in brackets or at its end; empty if there is none."""
    for found in (*_IN_BRACKETS.findall(name), *_AT_THE_END.findall(name)):
        if unit := unit_in(found):
            return unit
    return ""
