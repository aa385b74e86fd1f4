"""Plans that need a person: `reference` (an angle is read), `two_mounts` (the mechanism is moved) and
`gauge_study` (operators in turn remount it, and the stops of plan `full` are measured each time).
"""

from __future__ import annotations

import numpy as np

from station.five_bar import HOME, Robot, forward, inverse
from station.plans.boundary import on_the_boundary
from station.plans.full import chosen_by_exchange, full_positions
from station.plans.plan import PlanDesign, Visits, each_once, register
from station.plans.tour import sweeps
from station.records import JointAngle

LEVEL = JointAngle(joint=1, at_deg=0.0, reads_deg=0.0, sd_deg=0.005)
"""The reading of a level, as expected."""


def boundary_and_home(robot: Robot) -> Visits:
    """Six positions of the boundary; last the home position, where both arms are level."""
    return each_once(np.append(on_the_boundary(robot).positions, forward(robot.geometry, HOME[None])))


def both_sides_once(robot: Robot) -> Visits:
    """The positions of plan `full` from both sides, for one mounting point; the other has the same."""
    places = full_positions(robot)
    one = np.column_stack([np.ones(len(places)), np.where(np.arange(len(places)) % 2 == 0, 1, -1)])
    theta_deg = np.degrees(inverse(robot.geometry, places))
    found = sweeps(theta_deg, np.stack([one, -one]).astype(np.intp))
    return Visits(places, found.order, found.approach)


REFERENCE = register(PlanDesign("reference", boundary_and_home, references=(LEVEL,)))
TWO_MOUNTS = register(PlanDesign("two_mounts", both_sides_once, mounts=2))
GAUGE_STUDY = register(PlanDesign("gauge_study", chosen_by_exchange, run_kind="gauge_study"))
