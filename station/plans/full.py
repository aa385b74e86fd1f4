"""Plan `full`: 24 positions, chosen by exchange for the position error.

Each is read three times from one side and twice from the other.  The order keeps time apart from position,
so that a drift cannot pass for geometry.
"""

from __future__ import annotations

import numpy as np

from station.errors import InputRefused
from station.five_bar import GRID, INSET_MM, Robot
from station.plans.exchange_algorithm import choose
from station.plans.plan import PlanDesign, Visits, register
from station.plans.prediction import information_rows, known_beforehand, measured_at
from station.records import Complex

CANDIDATES = (41, 17)
FULL_PLACES = 24
APART_MM = 10.0
TIMES = (3, 2)
"""How often each place is read, from one side and from the other."""
SCALE_TRAVEL_MM = 350.0
ORDERS_TRIED = 200


def chosen_by_exchange(robot: Robot) -> Visits:
    """:raises InputRefused: the scale's travel does not cover the workspace."""
    places = _choose(robot, _candidates(robot), FULL_PLACES)
    return Visits(places, *_both_sides(places))


def _candidates(robot: Robot) -> Complex:
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + INSET_MM, x1 - INSET_MM, CANDIDATES[0])
    y = np.linspace(y0 + INSET_MM, y1 - INSET_MM, CANDIDATES[1])
    places = (x[:, None] + 1j * y[None, :]).ravel()
    travel = np.abs(places - robot.geometry.cd)
    if np.ptp(travel) > SCALE_TRAVEL_MM:
        raise InputRefused(
            f"The workspace needs {np.ptp(travel):.0f} mm of the scale's {SCALE_TRAVEL_MM:.0f} mm travel; "
            "check [workspace] and [mechanism] in the robot file."
        )
    return np.asarray(places)


def _choose(robot: Robot, candidates: Complex, count: int) -> Complex:
    mechanism = measured_at(robot, candidates)
    mean = np.array([p.prior_mean for p in mechanism.parameters])
    jacobian = mechanism.position_errors(mean)[1]
    weight = np.einsum("gdi,gdj->ij", jacobian, jacobian) / (GRID[0] * GRID[1])
    chosen = choose(
        information_rows(mechanism), candidates, known_beforehand(mechanism), weight, count, APART_MM
    )
    return np.asarray(candidates[chosen])


def _both_sides(places: Complex) -> tuple[np.ndarray, np.ndarray]:
    """Order of visits (R,) and approach signs (R, 2): every place from both sides, several times.

    Half the places are approached with both joints in the same sense, half in opposite senses, so
    that what one joint's direction does is not mixed up with the other's.
    """
    visits: list[tuple[int, int, int]] = []
    for k in range(len(places)):
        second = 1 if k % 2 == 0 else -1
        visits += [(k, 1, second)] * TIMES[0] + [(k, -1, -second)] * TIMES[1]
    table = np.array(visits)
    return _keep_time_apart(places, table)


def _keep_time_apart(places: Complex, visits: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of many random orders the one whose time tells least about place and approach.  Always the same one."""
    rng = np.random.default_rng(0)
    x, y = places.real[visits[:, 0]], places.imag[visits[:, 0]]
    what = np.column_stack([x, y, x * x, x * y, y * y, visits[:, 1], visits[:, 2]])
    what = (what - what.mean(axis=0)) / what.std(axis=0)
    time = np.linspace(-1.0, 1.0, len(visits))
    when = np.column_stack([time, time**2 - np.mean(time**2)])
    when /= when.std(axis=0)
    best, least = np.arange(len(visits)), np.inf
    for _ in range(ORDERS_TRIED):
        order = rng.permutation(len(visits))
        link = float(np.abs(when.T @ what[order]).max()) / len(visits)
        if link < least:
            best, least = order, link
    return visits[best, 0], visits[best, 1:]


FULL = register(PlanDesign("full", chosen_by_exchange))
