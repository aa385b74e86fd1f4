"""Under what readings were taken, for the catalogue to work on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from station.records import Flags, Measurements, Real

WARMED_BY_K = 0.05
"""A temperature column that moves less shows no warming."""
SAME_PLACE_RAD = 1e-6
RUN_UP_RAD = np.radians(0.5)
"""Run-up of a joint, as the station makes it unless its file says another."""
SHORT_MM = 0.2
"""A slider that moved less may hang on either side or between."""


@dataclass(frozen=True)
class Conditions:
    """Of K readings of a machine with n joints."""

    t_s: Real
    """(K,)"""
    theta: Real
    """(K, n) joint angles, rad, zero offsets included."""
    drive_angle: Real
    """(K, n) joint angles counted from each drive's zero, rad."""
    approach: Real
    """(K, n) sign of each joint's last motion, 0 unknown."""
    travel: Real
    """(K,) where the slider stands on the scale, mm: what a perfect scale would read."""
    slider_direction: Real
    """(K,) sign of the slider's last motion, 0 unknown."""
    slider_by_joint: Real
    """(K, n) the same if that joint alone arrives last, 0 unknown."""
    slider_net: Real
    """(K,) sign of the change of reading since the reading before, 0 unknown: what counts where the slider
    follows late or the way between is not known."""
    temperature_rise: Real | None
    """(K,) since the first reading, K; None where nothing was recorded or nothing changed."""
    payload_kg: Real | None
    lengths: Mapping[str, float]
    """Nominal lengths by parameter name, mm."""
    pull: Real
    """(K, n) sign of the load along each distal link: +1 pulled."""
    load: tuple[Real, ...]
    """(K, q) a joint: gravity's moment about it, one column a place where mass may sit, 1 when horizontal."""

    def __len__(self) -> int:
        return len(self.t_s)

    def take(self, rows: Flags) -> Conditions:
        """Of these readings only, mask (K,)."""
        taken: dict[str, Any] = {
            f.name: value[rows]
            for f in fields(self)
            if isinstance(value := getattr(self, f.name), np.ndarray)
        }
        return replace(self, **taken, load=tuple(part[rows] for part in self.load))


@dataclass(frozen=True)
class Reference:
    """What later readings (the fresh ones) are counted from."""

    temperature_c: float | None
    theta: Real
    """(n,) where the joints stood last."""
    travel: float
    """What was measured there, mm."""


def reference_of(measurements: Measurements) -> Reference:
    """Of the readings a model is learned on; `theta` is where they ended."""
    temperature = measurements.temperature_c
    warmed = temperature is not None and float(np.ptp(temperature)) > WARMED_BY_K
    return Reference(
        float(temperature[0]) if temperature is not None and warmed else None,
        measurements.theta[-1],
        float(measurements.distance[-1]),
    )


def temperature_rise(m: Measurements, reference: Reference) -> Real | None:
    """(K,) K above the reference; None where none was recorded then or now."""
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
    """(K, n) by what each joint came to its reading, rad, NaN where unknown; and (K,) where by a run-up.

    That is so where the recorded approach is not that of the way from the reading before, or the way is
    shorter than a run-up.
    """
    way = m.theta - came_from[:, :-1]
    way[np.abs(way) < SAME_PLACE_RAD] = 0.0
    short = np.abs(way) < RUN_UP_RAD
    run_up = ((m.approach != 0) & (short | (m.approach != np.sign(way)))).any(axis=1)
    return np.where(run_up[:, None], RUN_UP_RAD * m.approach, way), run_up


def last_motion(m: Measurements, by_joint: Real, came_from: Real) -> tuple[Real, Real]:
    """(K,) sign in which the distance last changed, and (K, n) by each joint alone; 0 unknown or too short to
    be sure.

    By the run-up where the recorded approach says that the last motion was another than the way from the
    reading before, else by that way; a slider that turned round on it is not known, for the joints do not
    arrive quite together.
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
