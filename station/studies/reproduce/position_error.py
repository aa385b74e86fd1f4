"""Position errors after a calibration, on the machine as it truly is."""

from __future__ import annotations

import numpy as np

from station.five_bar import GRID, HOME, SIZE, Robot, forward, inverse, perturbed
from station.published import boundary_positions
from station.records import Complex, Real
from station.studies.reproduce.printed import true_errors

EDGE_PLACES = 42
"""Evenly spaced along the edge of the workspace (Fig. 11)."""


def position_vectors(robot: Robot, truth: Real, identified: Real, targets: Complex) -> Complex:
    """(K,) position less targets (K,), mm: commands made with the errors identified (12,) of truth (12,)."""
    command = inverse(perturbed(robot.geometry, identified), targets) - identified[:2]
    return np.asarray(forward(perturbed(robot.geometry, truth), command + truth[:2]) - targets)


def position_errors(robot: Robot, truth: Real, identified: Real, targets: Complex) -> Real:
    """(K,) distances from targets, mm."""
    return np.abs(position_vectors(robot, truth, identified, targets))


def home(robot: Robot) -> Complex:
    """(1,) P_0."""
    return forward(robot.geometry, HOME[None])


def six(robot: Robot) -> Complex:
    """The optimal positions of Table 4."""
    return boundary_positions(robot.workspace_x, robot.workspace_y, 3)


def edge(robot: Robot) -> Complex:
    """The 42 positions of Fig. 11, from the upper left corner clockwise."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    corners = np.array([x0 + 1j * y1, x1 + 1j * y1, x1 + 1j * y0, x0 + 1j * y0, x0 + 1j * y1])
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(corners)))])
    at = np.linspace(0.0, along[-1], EDGE_PLACES, endpoint=False)
    return np.asarray(np.interp(at, along, corners.real) + 1j * np.interp(at, along, corners.imag))


def whole_workspace(robot: Robot) -> Complex:
    """The grid over which "largest position error" is taken."""
    return robot.workspace_grid(*GRID)


def before(group: int) -> dict[str, float]:
    """{home_mm, six_mm, edge_mm}: largest error without calibration, from the forward model alone."""
    robot, nothing = Robot.default(), np.zeros(SIZE)
    return {
        name: float(position_errors(robot, true_errors(group), nothing, targets).max())
        for name, targets in (("home_mm", home(robot)), ("six_mm", six(robot)), ("edge_mm", edge(robot)))
    }
