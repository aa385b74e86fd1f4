"""A calibration as a generator: yields walks, is sent their readings, returns the result.

A procedure never touches a device; `station.orchestrator` walks, stores and sends.
"""

from __future__ import annotations

from station.identification import identify
from station.measurements import from_readings
from station.plans import make_plan
from station.published_run import MAX_PASSES, PublishedRun
from station.records import PlanName, Procedure, Reading, Walk
from station.robot import Robot
from station.verified_run import fresh_stops, result_of


def start_procedure(plan: PlanName, robot: Robot) -> Procedure:
    """The procedure of a plan, not yet started.

    :raises InputRefused: the plan cannot be made for this robot.
    """
    return published(robot) if plan == "paper" else measured_and_verified(plan, robot)


def published(robot: Robot) -> Procedure:
    """Section 4 and 5: measure, identify, compensate, again until mu < mu_0 (eq. 32, 33)."""
    run = PublishedRun(robot)
    for number in range(1, MAX_PASSES + 1):
        stops = make_plan("paper", robot, run.total).stops
        readings: list[Reading] = yield Walk(f"Measuring, pass {number}", number, stops)
        run.absorb(readings)
        if run.converged:
            break
    return run.result()


def measured_and_verified(plan: PlanName, robot: Robot) -> Procedure:
    """The measurement model on a chosen plan, then fresh places that took no part in the fit."""
    readings: list[Reading] = yield Walk("Measuring", 1, make_plan(plan, robot).stops)
    fit = identify(robot, from_readings(readings))
    fresh: list[Reading] = yield Walk("Verifying at fresh places", 2, fresh_stops(fit))
    return result_of(fit, readings, fresh)
