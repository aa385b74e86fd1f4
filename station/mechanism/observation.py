"""Unknowns of a mechanism and its predicted readings, with derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, NamedTuple

from station.records import Motion, Real

Role = Literal["zero_offset", "geometry", "mechanism", "placement", "reading_offset"]
"""The owner of a parameter: a joint's zero, the robot, the measuring mechanism, the placement of robot and
target, or the readout.
"""


@dataclass(frozen=True, slots=True)
class Parameter:
    """One unknown.  Value and prior are in mm or rad; multiplied by `shown` they are in `unit`."""

    name: str
    role: Role
    unit: str
    prior_mean: float
    prior_sd: float
    """Standard deviation of the prior; inf without one."""
    shown: float = 1.0

    @property
    def lasting(self) -> bool:
        """Whether it is valid from one calibration to the next: a collision changes zeros, not links."""
        return self.role not in ("zero_offset", "reading_offset")


class Observation(NamedTuple):
    """The predicted readings: R rows for P parameters and n joints."""

    value: Real
    """(R,) mm."""
    by_parameter: Real
    """(R, P)"""
    by_joint: Real
    """(R, n) mm/rad"""
    motions: Mapping[Motion, Real] = MappingProxyType({})
    """(R, n) motion of the joints at each row, where the mechanism knows it."""
