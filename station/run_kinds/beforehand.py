"""Prior knowledge of a robot before a run: from its own runs, otherwise from other robots of its type."""

from __future__ import annotations

from station.identification import fleet_prior
from station.records import Beforehand
from station.run_kinds.kind import Start


def known_before(start: Start) -> Beforehand | None:
    """The current knowledge in the store; None without any."""
    robot = start.robot
    own = start.store.memory(robot.serial, start.began_at)
    if own is not None or robot.type is None:
        return own
    return fleet_prior(robot.type, robot, start.store.others_of_type(robot))
