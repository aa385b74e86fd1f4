"""Plan `diagnostic`: a grid forwards and backwards that shows the cause of a residual, then fresh positions.

The two directions approach most positions from both sides; ten positions, read three times from the same side
at different times, show the noise and the effect of time.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from station.five_bar import FRESH_INSET_MM, INSET_MM, Robot, inverse
from station.plans.duration import USUAL
from station.plans.plan import PlanDesign, Visits, register
from station.plans.tour import short_ways
from station.records import Complex, Real, Stop

COLUMNS, ROWS = 9, 5
REPEATED = 10
FRESH_PLACES = 40
SIDES = ((1, 1), (-1, -1), (1, -1), (-1, 1))


def diagnostic_grid(robot: Robot, inset_mm: float) -> Complex:
    """(45,) positions, row by row, mm; at least `inset_mm` from the workspace's edge."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + inset_mm, x1 - inset_mm, COLUMNS)
    y = np.linspace(y0 + inset_mm, y1 - inset_mm, ROWS)
    return np.asarray((x[None, :] + 1j * y[:, None]).ravel())


def diagnostic_visits(robot: Robot) -> Visits:
    """The grid forwards and backwards; ten positions are also read three times from one side.

    The path follows the columns, where neighbours are nearest for the joints. A further reading at the
    current position costs only its run-up.
    """
    places = diagnostic_grid(robot, INSET_MM)
    columns = np.arange(ROWS * COLUMNS).reshape(ROWS, COLUMNS).T
    there = np.concatenate([column[:: (-1) ** k] for k, column in enumerate(columns)])
    repeated = there[:: len(there) // REPEATED][:REPEATED]
    side = {int(place): SIDES[k % len(SIDES)] for k, place in enumerate(repeated)}
    visits: list[tuple[int, tuple[int, int]]] = []
    for place in (*there, *there[::-1]):
        visits.append((int(place), (0, 0)))
        if place in side:
            visits.append((int(place), side[int(place)]))
    last = visits[-1][0]
    visits += [(place, side[place]) for place in _short_way(robot, places, repeated, last)]
    order, approach = zip(*visits, strict=True)
    return Visits(places, np.array(order, dtype=np.intp), np.array(approach, dtype=np.intp))


def _short_way(robot: Robot, places: Complex, some: NDArray[np.intp], start: int) -> list[int]:
    """Some of the positions in the order of a short path that begins near another."""
    theta_deg = np.degrees(inverse(robot.geometry, places))
    ways = [some[way] for way in short_ways(theta_deg[some], len(some), np.random.default_rng(0))]
    ways += [way[::-1] for way in ways]
    lengths = [
        USUAL.along(theta_deg[way], np.zeros((len(way), 2)), theta_deg[start])[0].sum() for way in ways
    ]
    return [int(place) for place in ways[int(np.argmin(lengths))]]


def diagnostic_fresh_stops(robot: Robot, dtheta: Real, seed: int) -> tuple[Stop, ...]:
    """Random interior positions by seed; commanded with zero offsets dtheta (2,) rad subtracted."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    rng = np.random.default_rng(seed)
    x = rng.uniform(x0 + FRESH_INSET_MM, x1 - FRESH_INSET_MM, FRESH_PLACES)
    y = rng.uniform(y0 + FRESH_INSET_MM, y1 - FRESH_INSET_MM, FRESH_PLACES)
    theta = np.degrees(inverse(robot.geometry, x + 1j * y) - dtheta)
    return tuple(
        Stop(f"F{k + 1}", (float(x[k]), float(y[k])), (float(theta[k, 0]), float(theta[k, 1])))
        for k in range(FRESH_PLACES)
    )


DIAGNOSTIC = register(PlanDesign("diagnostic", diagnostic_visits, run_kind="diagnose"))
