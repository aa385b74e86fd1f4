"""The motion that tells look-alikes apart, on the machine: it goes on from the readings of a diagnostic run.

Its readings continue the numbers and the clock of that run, and all of them are diagnosed together: effects
of time are the ones that motion separates best, and they need one clock.  Fresh readings then judge anew.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from station.diagnosis import Experiment, experiment
from station.errors import InputRefused, NotApplicable
from station.five_bar import Robot
from station.plans import FRESH_PLACES
from station.records import CalibrationRequest, CalibrationResult, Procedure, Reading, Walk
from station.run_kinds.diagnose import diagnosed, judged
from station.store import Store

_NOT_GONE_ON_FROM = {
    "separating": "was the motion that tells apart what motion can; the causes name what else could",
    "dataset": "was imported from a file, not measured here; no run can go on from it",
}
NOTHING = "Motion alone can tell nothing more apart here; the causes name what could."


@dataclass(frozen=True, slots=True)
class Planned:
    """What a separating run would do."""

    experiment: Experiment
    duration_s: float
    """At the pace of the run it goes on from, fresh readings included."""


def planned(store: Store, calibration_id: int) -> Planned:
    """The experiment that separates what a run found from its look-alikes.

    :raises NotFound: no such run, or it has no diagnosis.
    :raises NotApplicable: there is none, or the machine is no longer the one that was measured; says why.
    """
    store.diagnosis(calibration_id)
    run = store.summary(calibration_id)
    if run["plan"] != "diagnostic":
        what = _NOT_GONE_ON_FROM.get(run["plan"], "is no diagnostic run; find the cause first")
        raise NotApplicable(f"Run {calibration_id} {what}.")
    robot = store.robot_of(calibration_id)
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


def check_separating(store: Store, calibration_id: int) -> None:
    """:raises NotApplicable: saying why; :raises NotFound: no such run, or it has no diagnosis."""
    planned(store, calibration_id)


def start_separating(store: Store, request: CalibrationRequest) -> Procedure:
    """The procedure that goes on from the run `of`, not yet started."""
    of = request.of or 0
    return separating(store.robot_of(of), store.readings(of))


def separating(robot: Robot, readings: list[Reading]) -> Generator[Walk, list[Reading], CalibrationResult]:
    """Read where the look-alikes differ most, and judge by fresh readings what is left of them.

    :param readings: all of the diagnostic run
    """
    found = experiment(diagnosed(robot, readings))
    if found is None:
        raise InputRefused(NOTHING)
    more = yield Walk("Telling look-alikes apart", 1, found.stops)
    return (yield from judged(robot, [*learned(readings), *more]))


def learned(readings: list[Reading]) -> list[Reading]:
    """Those that a run goes on from."""
    return [r for r in readings if r.walk == 1]


def since_start_s(store: Store, earlier: int, now: int) -> float:
    """Real time from the start of one run to that of a later one; 0 where the clock was set back."""
    first, second = (datetime.fromisoformat(store.summary(i)["started_at"]) for i in (earlier, now))
    return max((second - first).total_seconds(), 0.0)
