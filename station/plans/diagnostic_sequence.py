"""Plan `diagnostic`: a grid there and back that shows the cause of a residual, then fresh positions.

There and back shows most places from both sides, ten places read before and twice afterwards from the
same side show the noise and what time does.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from station.five_bar import FRESH_INSET_MM, INSET_MM, Robot, inverse
from station.plans.plan import PlanDesign, Visits, register
from station.records import Complex, Real, Stop

COLUMNS, ROWS = 9, 5
REPEATED = 10
FRESH_PLACES = 40
SIDES = ((1, 1), (-1, -1), (1, -1), (-1, 1))


def diagnostic_grid(robot: Robot, inset_mm: float) -> Complex:
    """(45,) places, row by row, mm; kept `inset_mm` from the workspace's edge."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + inset_mm, x1 - inset_mm, COLUMNS)
    y = np.linspace(y0 + inset_mm, y1 - inset_mm, ROWS)
    return np.asarray((x[None, :] + 1j * y[:, None]).ravel())


def diagnostic_visits() -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Order of places (120,) and wanted approach signs (120, 2), 0 where the way decides; always the same."""
    rows = np.arange(COLUMNS * ROWS).reshape(ROWS, COLUMNS)
    there = np.concatenate([row[:: (-1) ** k] for k, row in enumerate(rows)])
    repeated = np.random.default_rng(0).permutation(there[:: len(there) // REPEATED][:REPEATED])
    side = np.array([SIDES[k % len(SIDES)] for k in range(REPEATED)])
    free = np.zeros((2 * len(there), 2), dtype=int)
    order = np.concatenate([repeated, there, there[::-1], repeated, repeated])
    return order, np.concatenate([side, free, side, side])


def diagnostic_fresh_stops(robot: Robot, dtheta: Real, seed: int) -> tuple[Stop, ...]:
    """Random interior places, others for each seed; commanded with zero offsets dtheta (2,) rad taken off."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    rng = np.random.default_rng(seed)
    x = rng.uniform(x0 + FRESH_INSET_MM, x1 - FRESH_INSET_MM, FRESH_PLACES)
    y = rng.uniform(y0 + FRESH_INSET_MM, y1 - FRESH_INSET_MM, FRESH_PLACES)
    theta = np.degrees(inverse(robot.geometry, x + 1j * y) - dtheta)
    return tuple(
        Stop(f"F{k + 1}", (float(x[k]), float(y[k])), (float(theta[k, 0]), float(theta[k, 1])))
        for k in range(FRESH_PLACES)
    )


def there_and_back(robot: Robot) -> Visits:
    """The grid, its places and their approaches."""
    return Visits(diagnostic_grid(robot, INSET_MM), *diagnostic_visits())


DIAGNOSTIC = register(PlanDesign("diagnostic", there_and_back, run_kind="diagnose"))
