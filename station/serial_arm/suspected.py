"""The single wrong entry that makes angles and readings of an arm's log agree, where they do not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from itertools import combinations
from typing import Literal

import numpy as np

from station.records import Measurements, Real
from station.serial_arm.robot_file import Arm

AGREES = 0.1
"""Share of the misfit that may remain with the right entry: it removes nearly all."""
MOST_READINGS = 300
"""Evenly chosen ones are enough: an entry is wrong in all of them."""
UNITS_MM = {"inches": 25.4, "centimetres": 10.0}

Misfit = Callable[[Arm, Measurements], float]
"""Median misfit of an arm and readings, mm; inf if they cannot be compared."""


def wrong_entry(robot: Arm, m: Measurements, off_mm: float, misfit: Misfit) -> str:
    """A sentence about the entry with which the misfit `off_mm` disappears; empty if no single one does."""
    tried = [(misfit(arm, _some(read)), text) for arm, read, text in _entries(robot, m)]
    left, text = min(tried, key=lambda one: one[0])
    if not left < AGREES * off_mm:
        return ""
    return f". {text}, they agree to {left:.2g} mm: correct this entry."


def _entries(robot: Arm, m: Measurements) -> Iterator[tuple[Arm, Measurements, str]]:
    joints = list(range(m.joints))
    for i in joints:
        sign = np.ones(m.joints)
        sign[i] = -1.0
        yield robot, replace(m, theta=sign * m.theta), f"With the sign of joint {i + 1} reversed"
    for i, j in combinations(joints, 2):
        order = joints.copy()
        order[i], order[j] = j, i
        yield robot, replace(m, theta=m.theta[:, order]), f"With joints {i + 1} and {j + 1} exchanged"
    for name, factor in UNITS_MM.items():
        yield robot, _measured(m, partial(np.multiply, factor)), f"With the readings in {name}"
    rows = np.arange(len(m))
    for by, kept, where in ((-1, rows[:-1], "below"), (1, rows[1:], "above")):
        moved = _measured(m, partial(np.roll, shift=by, axis=0)).take(kept)
        yield robot, moved, f"With the readings of the row {where}"
    other: Literal["standard", "modified"] = "modified" if robot.convention == "standard" else "standard"
    yield replace(robot, convention=other), m, f"With the {other} convention in the robot file"


def _measured(m: Measurements, change: Callable[[Real], Real]) -> Measurements:
    tracker = None if m.tracker is None else change(m.tracker)
    return replace(m, distance=change(m.distance), tracker=tracker, came_from=None)


def _some(m: Measurements) -> Measurements:
    return m.take(np.unique(np.linspace(0, len(m) - 1, min(len(m), MOST_READINGS)).astype(np.intp)))
