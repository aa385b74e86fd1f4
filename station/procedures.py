"""A calibration as a generator: yields walks, is sent their readings, returns the result.

A procedure never touches a device; `station.orchestrator` walks, stores and sends.
"""

from __future__ import annotations

from station.positions import boundary_stops
from station.published_run import MAX_PASSES, PublishedRun
from station.records import CalibrationResult, PlanName, Procedure, Reading, Walk
from station.robot import Robot


def start_procedure(plan: PlanName, robot: Robot) -> Procedure:
    """The procedure of a plan, not yet started.

    :raises InputRefused: the plan cannot be made for this robot.
    """
    return published(robot)


def published(robot: Robot) -> Procedure:
    """Section 4 and 5: measure, identify, compensate, again until mu < mu_0 (eq. 32, 33)."""
    run = PublishedRun(robot)
    for number in range(1, MAX_PASSES + 1):
        stops = boundary_stops(robot, run.total)
        readings: list[Reading] = yield Walk(f"Measuring, pass {number}", number, stops)
        run.absorb(readings)
        if run.converged:
            break
    result: CalibrationResult = run.result()
    return result
