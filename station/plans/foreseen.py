"""Plan `adaptive` as far as it can be predicted: the first positions for a robot as in its file.

The run itself chooses each position from the readings before it (`station.run_kinds.adaptive`).
"""

from __future__ import annotations

import numpy as np

from station.five_bar import HOME, Robot, inverse
from station.plans.duration import USUAL
from station.plans.full import candidates, position_weight
from station.plans.next_position import gains, with_readings
from station.plans.plan import PlanDesign, Visits, each_once, register
from station.plans.prediction import information_rows, known_beforehand, measured_at

FORESEEN = 6


def first_positions(robot: Robot) -> Visits:
    """Each position is the best per second, given those before it."""
    places = candidates(robot)
    mechanism = measured_at(robot, places)
    rows, weight = information_rows(mechanism), position_weight(mechanism)
    covariance = np.linalg.inv(known_beforehand(mechanism))
    theta_deg, here_deg = np.degrees(inverse(robot.geometry, places)), np.degrees(HOME)
    free = np.zeros_like(theta_deg)
    chosen: list[int] = []
    for _ in range(FORESEEN):
        duration_s = USUAL.duration_s(here_deg, theta_deg, free)
        best = int(np.argmax(gains(covariance, rows, weight) / duration_s))
        covariance, here_deg = with_readings(covariance, rows[[best]]), theta_deg[best]
        chosen.append(best)
    return each_once(places[chosen])


ADAPTIVE = register(PlanDesign("adaptive", first_positions))
