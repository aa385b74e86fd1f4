"""Gauge study: operators in turn remount the mechanism, and the station calibrates each time.

Its readings are evaluated for the station (`gauge_evaluation`); it does not evaluate the robot, so it has no
verdict. An interrupted study continues after the last mounting that it finished.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from itertools import groupby

import numpy as np

from station.errors import NotApplicable
from station.five_bar import Robot
from station.plans import make_plan
from station.quality import gauge_sd
from station.records import (
    Ask,
    CalibrationRequest,
    CalibrationResult,
    MeasurementSequence,
    Procedure,
    Reading,
    Real,
    State,
    StudyDesign,
    because,
)
from station.run_kinds.fits import fit_of
from station.run_kinds.kind import Continued, RunKind, Start, register, request_of
from station.store import Store

KIND = "gauge_study"


def design_of(store: Store, run: int) -> StudyDesign:
    """The design of a study; a continued one has the design of the earlier one.  :raises NotFound:"""
    request = request_of(store, run)
    while request.of is not None:
        request = request_of(store, request.of)
    return request.study or StudyDesign()


def gauge_study(start: Start) -> Procedure:
    """The procedure, not yet started."""
    design = start.request.study or StudyDesign()
    stops = make_plan(KIND, start.robot).stops
    readings: list[Reading] = []
    if start.request.of is not None:
        readings = taken_over(start.store, start.of)
        design = design_of(start.store, start.of)
    zeros_deg = zero_offsets_deg(start.robot, readings)
    for mounting in range(len(zeros_deg) // design.repeats, design.all_mountings):
        operator = design.operator_of(mounting)
        yield Ask(
            f"Mounting {mounting + 1} of {design.all_mountings}",
            design.sequence_of(mounting, 0),
            f"Operator {operator} of {design.operators}: take the mechanism off, mount it again at its"
            f" mounting point as always, then confirm. Mounting {mounting + 1} of {design.all_mountings}.",
            "confirm",
            mounted_at=start.robot.c,
            mounting=mounting + 1,
        )
        for repeat in range(design.repeats):
            taken: list[Reading] = yield MeasurementSequence(
                f"Operator {operator}, mounting {mounting + 1}, calibration {repeat + 1} of {design.repeats}",
                design.sequence_of(mounting, repeat),
                stops,
                last=mounting + 1 == design.all_mountings and repeat + 1 == design.repeats,
            )
            # at once: a study whose readings are impossible for this robot ends here
            zeros_deg += zero_offsets_deg(start.robot, taken)
    sd_deg = gauge_sd(in_cells(zeros_deg, design)[None])
    return CalibrationResult(
        verdict="fail",  # the run has no robot to judge
        outcome="good",
        reason=because(
            "gauge_studied",
            operators=design.operators,
            mountings=design.mountings,
            repeats=design.repeats,
            sd1_deg=float(sd_deg[0]),
            sd2_deg=float(sd_deg[1]),
        ),
        method=KIND,
        zero_offsets=(),
    )


def zero_offsets_deg(robot: Robot, readings: list[Reading]) -> list[Real]:
    """(2,) of each sequence, each identified by its own readings alone, in their order.

    :raises InputRefused: as `identify`.
    """
    return [np.degrees(fit_of(robot, taken, None, 0.0).dtheta) for taken in by_sequence(readings)]


def by_sequence(readings: list[Reading]) -> list[list[Reading]]:
    """Readings of each calibration of a study, in order."""
    return [list(taken) for _, taken in groupby(readings, lambda reading: reading.sequence)]


def in_cells(of_sequences: Sequence[Real], design: StudyDesign) -> Real:
    """(operators, mountings, repeats, ...) from one value per sequence, in order."""
    values = np.array(of_sequences)
    turns = values.reshape(design.mountings, design.operators, design.repeats, *values.shape[1:])
    return np.asarray(np.swapaxes(turns, 0, 1))


def mountings_taken(store: Store, run: int) -> int:
    """Number of mountings that a study measured completely. :raises NotFound:"""
    design = design_of(store, run)
    stops = len(make_plan(KIND, store.robot_of(run)).stops)
    whole = [len(taken) == stops for taken in by_sequence(store.readings(run))]
    return sum(whole) // design.repeats


def taken_over(store: Store, run: int) -> list[Reading]:
    """The readings of the mountings that an earlier study finished.  :raises NotFound:"""
    last = mountings_taken(store, run) * design_of(store, run).repeats
    return [reading for reading in store.readings(run) if reading.sequence <= last]


def check_gauge_study(store: Store, request: CalibrationRequest) -> None:
    """:raises NotApplicable: the earlier study cannot be continued, with the reason. :raises NotFound:"""
    if request.of is None:
        return
    run = store.summary(request.of)
    if run.kind != KIND:
        raise NotApplicable(f"Run {run.id} is no gauge study; only a gauge study can go on.")
    if run.state is State.SUCCEEDED:
        raise NotApplicable(f"Run {run.id} is finished; start a new gauge study.")
    if store.robot_of(run.id).to_json() != store.robot(run.robot_serial).to_json():
        raise NotApplicable(
            f"The file of robot {run.robot_serial} has changed since; start a new gauge study."
        )
    if writes := store.zero_writes(run.robot_serial, since=run.id):
        raise NotApplicable(
            f"Run {writes[0].run_id} has changed the drives' zeros since; start a new gauge study."
        )


def continued(store: Store, request: CalibrationRequest) -> Continued | None:
    """Readings that a continued study already has, and the time since it began."""
    if request.of is None or not (readings := taken_over(store, request.of)):
        return None
    began = store.summary(request.of).started_at
    elapsed_s = 0.0 if began is None else (datetime.now(UTC) - began).total_seconds()
    return Continued(readings, max(elapsed_s, 0.0))


GAUGE_STUDY = register(
    RunKind(
        KIND,
        gauge_study,
        check=check_gauge_study,
        continues=continued,
        judged=False,
        rests_on_scale=False,
    )
)
