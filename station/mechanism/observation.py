"""Unknowns of a mechanism and what it would show, with derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

from station.records import Real

Role = Literal["zero_offset", "geometry", "mechanism", "placement", "reading_offset"]
"""What a parameter belongs to: a joint's zero, the robot, the measuring mechanism, where robot and target
are placed, or the readout."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """One unknown.  Value and prior are in mm or rad; `shown` times that is in `unit`."""

    name: str
    role: Role
    unit: str
    prior_mean: float
    prior_sd: float
    """Standard deviation of what is known beforehand; inf when nothing is."""
    shown: float = 1.0

    @property
    def lasting(self) -> bool:
        """Whether it stays from one calibration to the next: a collision changes zeros, not links."""
        return self.role not in ("zero_offset", "reading_offset")


class Observation(NamedTuple):
    """What the machine would show: R rows for P parameters and n joints."""

    value: Real
    """(R,) mm."""
    by_parameter: Real
    """(R, P)"""
    by_joint: Real
    """(R, n) mm/rad"""
