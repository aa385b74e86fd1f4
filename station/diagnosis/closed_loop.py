"""The closed loop on one set of readings, with or without fresh readings."""

from __future__ import annotations

from station.diagnosis.mistakes import Context
from station.diagnosis.traced_loop import TracedDiagnosis, traced
from station.diagnosis.weighed_loop import WeighedDiagnosis, weighed
from station.five_bar import Robot
from station.machines import AnyRobot
from station.records import Measurements

AnyDiagnosis = TracedDiagnosis | WeighedDiagnosis


def diagnose(
    robot: AnyRobot,
    measurements: Measurements,
    fresh: Measurements | None = None,
    context: Context | None = None,
) -> AnyDiagnosis:
    """Diagnose a five-bar with the set of its explanations, and an arm effect by effect.

    :raises MistakeRefused: a five-bar's file contains a mistake that can be named.
    :raises InputRefused: the readings are malformed or too few; the error states what is missing.
    """
    if isinstance(robot, Robot):
        return weighed(robot, measurements, fresh, context)
    return traced(robot, measurements, fresh)
