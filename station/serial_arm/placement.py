"""Positions of the points on the tool, and of base and instrument, for each reading of a log.

A log may have several points on the tool (`mount`), measured in turn, and several set-ups (`setup`): base or
instrument were moved between them.  Each point and each set-up has separate unknowns.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from station.errors import InputRefused
from station.mechanism import Parameter
from station.records import Index, Measurements, Real

DEGREES = 180.0 / np.pi
FEWEST = 6
"""Minimum number of readings of a set-up: its six unknowns with some redundancy."""


class Placement:
    """Unknowns: three of each point, then of each set-up six, or three of the instrument's origin."""

    def __init__(self, m: Measurements, *, by_range: bool) -> None:
        self.mount: Index = m.mount
        self.setup: Index = m.setup_index
        self.by_range = by_range
        self._mounts, self._setups = m.mounts, m.setups
        self._size = 3 if by_range else 6

    def parameters(self, tool_sd_mm: float) -> tuple[Parameter, ...]:
        """Their priors: points as in the robot file, none for set-ups."""
        out = []
        for label in self._mounts:
            at = "" if label == self._mounts[0] else f"@{label}"
            out += [Parameter(f"tool_{a}{at}", "placement", "mm", 0.0, tool_sd_mm) for a in "xyz"]
        for label in self._setups:
            at = "" if label == self._setups[0] else f"@{label}"
            name = "origin" if self.by_range else "base"
            out += [Parameter(f"{name}_{a}{at}", "placement", "mm", 0.0, np.inf) for a in "xyz"]
            if not self.by_range:
                out += [Parameter(f"base_r{a}{at}", "placement", "deg", 0.0, np.inf, DEGREES) for a in "xyz"]
        return tuple(out)

    def check(self) -> None:
        """:raises InputRefused: a set-up has too few readings to be placed."""
        count = np.bincount(self.setup, minlength=len(self._setups))
        for label, readings in zip(self._setups, count, strict=True):
            if 0 < readings < FEWEST:
                raise InputRefused(
                    f"Set-up {label!r} has {readings} readings; at least {FEWEST} are needed to place base "
                    "and instrument. Leave these rows out."
                )

    def tool(self, q: Real) -> Real:
        """(3,) or (K, 3) mm, the point of each reading, from the last unknowns q."""
        points = q[: 3 * len(self._mounts)].reshape(-1, 3)
        return points[0] if len(points) == 1 else points[self.mount]

    def setups(self, q: Real) -> Real:
        """(S, 3 or 6) of each set-up, from the last unknowns q."""
        return q[3 * len(self._mounts) :].reshape(-1, self._size)

    def of_points(self, by_tool: Real) -> Real:
        """(K, 3, 3M) from the derivatives (K, 3, 3) by each reading's own point."""
        return _spread(by_tool, self.mount, len(self._mounts))

    def of_setups(self, own: Real) -> Real:
        """(K, ..., S q) from the derivatives (K, ..., q) by each reading's own set-up."""
        return _spread(own, self.setup, len(self._setups))

    @cached_property
    def rows(self) -> tuple[Index, ...]:
        """Readings of each set-up."""
        return tuple(np.flatnonzero(self.setup == s) for s in range(len(self._setups)))


def _spread(own: Real, group: Index, groups: int) -> Real:
    if groups == 1:
        return own
    mine = (group[:, None] == np.arange(groups)).reshape(len(own), *([1] * (own.ndim - 2)), groups, 1)
    return np.asarray((mine * own[..., None, :]).reshape(*own.shape[:-1], -1))
