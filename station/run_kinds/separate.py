"""Further diagnosis: the motion that distinguishes causes which an earlier diagnostic run left undecided.

Its readings continue the numbers and the clock of that run, and all of them are diagnosed together: effects
of time are the ones that motion separates best, and they need one clock. New fresh readings then confirm the
result.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from station.diagnosis import Experiment, experiment
from station.errors import InputRefused, NotApplicable
from station.five_bar import Robot
from station.plans import FRESH_PLACES
from station.records import CalibrationRequest, CalibrationResult, MeasurementSequence, Procedure, Reading
from station.run_kinds.diagnose import diagnosed, judged
from station.run_kinds.kind import Continued, RunKind, Start, register, robot_as_measured
from station.store import Store

_NOT_CONTINUED = {
    "separate": "was the motion that distinguishes what motion can; each cause lists the experiment that can",
    "import": "was imported from a file, not measured here; no run can continue it",
}
NOTHING = "No further motion can distinguish these causes. Each lists the experiment that can."


@dataclass(frozen=True, slots=True)
class Planned:
    """The plan of a separating run."""

    experiment: Experiment
    duration_s: float
    """Duration at the pace of the run it continues, fresh readings included."""


def planned(store: Store, calibration_id: int) -> Planned:
    """The experiment that separates the effects found by a run from their aliases.

    :raises NotFound: no such run, or it has no diagnosis.
    :raises NotApplicable: there is none, or the machine has changed since the measurement; the error states
    why.
    """
    store.diagnosis(calibration_id)
    run = store.summary(calibration_id)
    if run.kind != "diagnose":
        what = _NOT_CONTINUED.get(run.kind, "is no diagnostic run; find the cause first")
        raise NotApplicable(f"Run {calibration_id} {what}.")
    robot = robot_as_measured(store, store.calibration(calibration_id))
    if robot.to_json() != store.robot(robot.serial).to_json():
        raise NotApplicable(f"The file of robot {robot.serial} has changed since; find the cause again.")
    if writes := store.zero_writes(robot.serial, since=calibration_id):
        raise NotApplicable(
            f"Run {writes[0].run_id} has changed the drives' zeros since; find the cause again."
        )
    readings = store.readings(calibration_id)
    found = experiment(diagnosed(robot, readings))
    if found is None:
        raise NotApplicable(NOTHING)
    pace_s = float(np.median(np.diff([r.t_s for r in readings])))
    return Planned(found, (len(found.stops) + FRESH_PLACES) * pace_s)


def check_separate(store: Store, request: CalibrationRequest) -> None:
    """:raises NotApplicable: with the reason; :raises NotFound: no such run, or it has no diagnosis."""
    planned(store, request.of or 0)


def separate(start: Start) -> Procedure:
    """The procedure that continues an earlier run, not yet started."""
    robot = robot_as_measured(start.store, start.store.calibration(start.of))
    return separating(robot, start.store.readings(start.of))


def separating(
    robot: Robot, readings: list[Reading]
) -> Generator[MeasurementSequence, list[Reading], CalibrationResult]:
    """Measure where the aliases differ most, and test the remaining ones with fresh readings.

    :param readings: all of the diagnostic run
    """
    found = experiment(diagnosed(robot, readings))
    if found is None:
        raise InputRefused(NOTHING)
    more = yield MeasurementSequence("Distinguishing the causes", 1, found.stops)
    return (yield from judged(robot, [*learned(readings), *more]))


def learned(readings: list[Reading]) -> list[Reading]:
    """The readings that a run continues."""
    return [r for r in readings if r.sequence == 1]


def continued(store: Store, request: CalibrationRequest) -> Continued:
    """The readings that the earlier run learned from, and the time since it started."""
    assert request.of is not None
    earlier = store.summary(request.of).started_at
    elapsed_s = 0.0 if earlier is None else (datetime.now(UTC) - earlier).total_seconds()
    return Continued(learned(store.readings(request.of)), max(elapsed_s, 0.0))


SEPARATE = register(RunKind("separate", separate, check=check_separate, continues=continued))
