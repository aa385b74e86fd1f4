"""Unknowns of a mechanism and what it would show, with derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from station.records import Real


@dataclass(frozen=True, slots=True)
class Parameter:
    """One unknown.  Value and prior are in mm or rad; `shown` times that is in `unit`."""

    name: str
    unit: str
    prior_mean: float
    prior_sd: float
    """Standard deviation of what is known beforehand; inf when nothing is."""
    shown: float = 1.0


class Observation(NamedTuple):
    """What the machine would show: R rows for P parameters and n joints."""

    value: Real
    """(R,) mm."""
    by_parameter: Real
    """(R, P)"""
    by_joint: Real
    """(R, n) mm/rad"""
