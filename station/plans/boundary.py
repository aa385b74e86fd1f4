"""Plans `paper` and `rapid`: the positions of Fig. 7, once each.

`rapid` uses the memory of a full run.  Positions only in the corners would not be better for it and could not
contradict a wrong memory (docs/decisions/0004-rapid-places.md).
"""

from __future__ import annotations

from station.five_bar import Robot
from station.plans.plan import PlanDesign, Visits, each_once, register
from station.published import boundary_positions, positions_per_edge


def on_the_boundary(robot: Robot) -> Visits:
    """The paper's positions for the workspace of this robot."""
    count = positions_per_edge(robot)
    return each_once(boundary_positions(robot.workspace_x, robot.workspace_y, count))


PAPER = register(PlanDesign("paper", on_the_boundary))
RAPID = register(PlanDesign("rapid", on_the_boundary))
