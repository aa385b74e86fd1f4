"""A value with its standard uncertainty and unit."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value with its standard uncertainty and unit."""

    name: str
    value: float
    sd: float
    unit: str
