"""The conditions under which readings were taken, as input of the catalogue."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from station.records import Flags, Measurements, Real

WARMED_BY_K = 0.05
"""A temperature column with a smaller range shows no warming."""
SAME_PLACE_RAD = 1e-6
RUN_UP_RAD = np.radians(0.5)
"""Run-up of a joint, as the station makes it unless its file specifies another."""
SHORT_MM = 0.2
"""After a smaller motion the slider may be on either side of its play or in between."""


@dataclass(frozen=True)
class Conditions:
    """Conditions of K readings of a machine with n joints."""

    t_s: Real
    """(K,)"""
    theta: Real
    """(K, n) joint angles, rad, zero offsets included."""
    drive_angle: Real
    """(K, n) joint angles counted from each drive's zero, rad."""
    approach: Real
    """(K, n) sign of each joint's last motion, 0 unknown."""
    travel: Real
    """(K,) position of the slider on the scale, mm: the reading of a perfect scale."""
    slider_direction: Real
    """(K,) sign of the slider's last motion, 0 unknown."""
    slider_by_joint: Real
    """(K, n) the same if that joint alone arrives last, 0 unknown."""
    slider_net: Real
    """(K,) sign of the change since the previous reading, 0 unknown: relevant where the slider lags or the
    motion in between is unknown.
    """
    temperature_rise: Real | None
    """(K,) temperature rise since the first reading, K; None if not recorded or constant."""
    payload_kg: Real | None
    lengths: Mapping[str, float]
    """Nominal lengths by parameter name, mm."""
    pull: Real
    """(K, n) sign of the load along each distal link: +1 in tension."""
    load: tuple[Real, ...]
    """(K, q) per joint: gravity's moment about it, one column for each mass, 1 when horizontal."""
    step: Real | None = None
    """(K, n) motion of each joint from the previous reading, rad; None if it is of no interest."""
    speed: Real | None = None
    """(K, n) speed of each joint as it was read, rad/s, if it moved from reading to reading."""

    def __len__(self) -> int:
        return len(self.t_s)

    def take(self, rows: Flags) -> Conditions:
        """The conditions of these readings only, mask (K,)."""
        taken: dict[str, Any] = {
            f.name: value[rows]
            for f in fields(self)
            if isinstance(value := getattr(self, f.name), np.ndarray)
        }
        return replace(self, **taken, load=tuple(part[rows] for part in self.load))


@dataclass(frozen=True)
class Reference:
    """The reference that later readings (the fresh ones) are counted from."""

    temperature_c: float | None
    theta: Real
    """(n,) last angles of the joints."""
    travel: float
    """Distance measured there, mm."""


def reference_of(measurements: Measurements) -> Reference:
    """The reference of the readings a model is learned from; `theta` is their last pose."""
    temperature = measurements.temperature_c
    warmed = temperature is not None and float(np.ptp(temperature)) > WARMED_BY_K
    return Reference(
        float(temperature[0]) if temperature is not None and warmed else None,
        measurements.theta[-1],
        float(measurements.distance[-1]),
    )


def temperature_rise(m: Measurements, reference: Reference) -> Real | None:
    """(K,) K above the reference; None where none was recorded at the reference or in these readings."""
    if reference.temperature_c is None or m.temperature_c is None:
        return None
    return np.asarray(m.temperature_c - reference.temperature_c)


def readings_before(m: Measurements, reference: Reference | None) -> Real:
    """(K, n + 1) joint angles and distance before each reading, NaN where unknown."""
    came_from = np.array(m.came_from)
    if reference is not None:
        unknown = np.isnan(came_from).any(axis=1)
        came_from[unknown] = [*reference.theta, reference.travel]
    return came_from


def last_way(m: Measurements, came_from: Real) -> tuple[Real, Flags]:
    """(K, n) motion of each joint before its reading, rad, NaN if unknown; (K,) whether it was a run-up.

    It was a run-up where the recorded approach differs from that of the motion from the previous reading, or
    that motion is shorter than a run-up.
    """
    way = m.theta - came_from[:, :-1]
    way[np.abs(way) < SAME_PLACE_RAD] = 0.0
    short = np.abs(way) < RUN_UP_RAD
    run_up = ((m.approach != 0) & (short | (m.approach != np.sign(way)))).any(axis=1)
    return np.where(run_up[:, None], RUN_UP_RAD * m.approach, way), run_up


def last_motion(m: Measurements, by_joint: Real, came_from: Real) -> tuple[Real, Real]:
    """(K,) sign in which the distance last changed, and (K, n) by each joint alone; 0 unknown or too short to
    be certain.

    It is that of the run-up where the recorded approach shows that the last motion was not the motion from
    the previous reading, otherwise of that motion; it is unknown for a slider that reversed during it, as the
    joints do not arrive exactly together.
    """
    last, run_up = last_way(m, came_from)
    each = np.nan_to_num(by_joint * last)
    moved = np.sum(each, axis=1)
    direction = np.sign(moved)
    known = (np.abs(moved) >= SHORT_MM) & (run_up | (direction == net_travel(m, came_from)))
    return np.where(known, direction, 0.0), np.where(np.abs(each) >= SHORT_MM, np.sign(each), 0.0)


def net_travel(m: Measurements, came_from: Real) -> Real:
    """(K,) sign of the change of reading, 0 unknown."""
    return np.nan_to_num(np.sign(m.distance - came_from[:, -1]))
