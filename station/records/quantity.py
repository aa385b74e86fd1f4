"""A value with its standard uncertainty and unit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


def vars_of(q: Quantity) -> dict[str, Any]:
    """A quantity as JSON."""
    return {"name": q.name, "value": q.value, "sd": q.sd, "unit": q.unit}


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value with its standard uncertainty and unit."""

    name: str
    value: float
    sd: float
    unit: str
