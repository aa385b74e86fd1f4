"""Position errors after a calibration, on the machine as it truly is."""

from __future__ import annotations

import numpy as np

from station.error_model import perturbed
from station.five_bar import GRID
from station.kinematics import HOME, Complex, Real, forward, inverse
from station.published import boundary_positions
from station.robot import Robot

EDGE_PLACES = 42
"""Evenly spaced along the edge of the workspace (Fig. 11)."""


def position_errors(robot: Robot, truth: Real, identified: Real, targets: Complex) -> Real:
    """(K,) mm from targets (K,) when commands are made with the identified errors (12,) of truth (12,)."""
    command = inverse(perturbed(robot.geometry, identified), targets) - identified[:2]
    return np.asarray(np.abs(forward(perturbed(robot.geometry, truth), command + truth[:2]) - targets))


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
