"""Plan `full`: 24 positions, chosen by exchange for the position error.

Each is read three times from one side and twice from the other.  They are visited in short sweeps whose
directions vary, so that a drift does not look like geometry.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from station.errors import InputRefused
from station.five_bar import GRID, INSET_MM, FiveBar, Robot, inverse
from station.plans.exchange_algorithm import choose
from station.plans.plan import PlanDesign, Visits, register
from station.plans.prediction import information_rows, known_beforehand, measured_at
from station.plans.tour import sweeps
from station.records import Complex, Real

CANDIDATES = (41, 17)
FULL_PLACES = 24
APART_MM = 10.0
TIMES = (3, 2)
"""Number of readings at each position, from one side and from the other."""
SCALE_TRAVEL_MM = 350.0


def chosen_by_exchange(robot: Robot) -> Visits:
    """:raises InputRefused: the scale's travel does not cover the workspace."""
    return _chosen(replace(robot, serial=""))


def full_positions(robot: Robot) -> Complex:
    """(24,) mm.  :raises InputRefused: as `candidates`."""
    return chosen_by_exchange(robot).positions


@lru_cache(maxsize=16)
def _chosen(robot: Robot) -> Visits:
    """Cached: robots that differ only in their serials have the same positions."""
    found = _both_sides(robot, _choose(robot, candidates(robot), FULL_PLACES))
    for part in found:
        part.setflags(write=False)
    return found


def candidates(robot: Robot) -> Complex:
    """(N,) positions to choose from, mm.

    :raises InputRefused: the scale's travel does not cover the workspace.
    """
    places = inset_grid(robot, *CANDIDATES)
    travel = np.abs(places - robot.geometry.cd)
    if np.ptp(travel) > SCALE_TRAVEL_MM:
        raise InputRefused(
            f"The workspace needs {np.ptp(travel):.0f} mm of the scale's {SCALE_TRAVEL_MM:.0f} mm travel; "
            "check [workspace] and [mechanism] in the robot file."
        )
    return places


def inset_grid(robot: Robot, nx: int, ny: int) -> Complex:
    """(nx * ny,) evenly spaced positions of the workspace, a little inside its edges, mm."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + INSET_MM, x1 - INSET_MM, nx)
    y = np.linspace(y0 + INSET_MM, y1 - INSET_MM, ny)
    return np.asarray((x[:, None] + 1j * y[None, :]).ravel())


def _choose(robot: Robot, candidates: Complex, count: int) -> Complex:
    mechanism = measured_at(robot, candidates)
    rows, known = information_rows(mechanism), known_beforehand(mechanism)
    chosen = choose(rows, candidates, known, position_weight(mechanism), count, APART_MM)
    return np.asarray(candidates[chosen])


def position_weight(mechanism: FiveBar) -> Real:
    """(P, P) M: trace(C M) is the mean square position error over the workspace, mm^2."""
    mean = mechanism.start
    jacobian = mechanism.position_errors(mean)[1]
    return np.asarray(np.einsum("gdi,gdj->ij", jacobian, jacobian) / (GRID[0] * GRID[1]))


def _both_sides(robot: Robot, places: Complex) -> Visits:
    """Every position from both sides, several times, in sweeps.

    Half the positions are approached with both joints in the same sense, half in opposite senses, so that the
    effects of the two joints' directions are not confounded.
    """
    one = np.column_stack([np.ones(len(places)), np.where(np.arange(len(places)) % 2 == 0, 1, -1)])
    sides = np.stack([one] * TIMES[0] + [-one] * TIMES[1]).astype(np.intp)
    theta_deg = np.degrees(inverse(robot.geometry, places))
    found = sweeps(theta_deg, sides)
    return Visits(places, found.order, found.approach)


FULL = register(PlanDesign("full", chosen_by_exchange))
