"""The expected position error of a robot over its workspace before and after a run, from what is stored.

The run's readings are fitted again, as for an application.  The bound of the run's result applies to all
positions together; the bounds of single positions are drawn in proportion, so that the largest equals that
bound.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from station.errors import InputRefused, NotApplicable
from station.fitting import ErrorFields
from station.five_bar import Robot, inverse
from station.identification import bounds_mm, error_fields, fresh_readings, verify
from station.motion import shift_of
from station.published import PublishedRun
from station.records import (
    Calibration,
    Complex,
    ErrorMap,
    Flags,
    FreshReading,
    Measurements,
    Real,
    from_readings,
)
from station.run_kinds.apply import Source, source_of
from station.run_kinds.diagnose import diagnosed
from station.run_kinds.kind import robot_as_measured
from station.settings import JointSettings
from station.store import Store

STEPS = 36
"""Number of steps of the grid along the longer side of the workspace."""
DIGITS = 6
"""Decimals of a millimetre: nanometres."""


@dataclass(frozen=True)
class _Known:
    """The knowledge of the machine from a run."""

    robot: Robot
    wanted: Calibration
    """The run for which a required accuracy was given."""
    fields: Callable[[Complex], ErrorFields]
    bound_mm: float | None
    fresh: tuple[FreshReading, ...]


def error_map(store: Store, run: int, joints: Sequence[JointSettings]) -> ErrorMap:
    """The error map of a run that identified or wrote zero offsets.

    :param joints: range of the commands of each joint
    :raises NotFound: no such run.
    :raises NotApplicable: it has no zero offsets, or its readings do not satisfy the model; the error states
    why.
    """
    calibration = store.calibration(run)
    known_of = _BY_KIND.get(calibration.kind)
    if known_of is None or calibration.verdict is None or not calibration.zero_offsets:
        raise NotApplicable(f"Run {run} has no error map: it identified no zero offsets.")
    try:
        known = known_of(store, calibration)
    except InputRefused as refusal:
        raise NotApplicable(f"Run {run} has no error map: {refusal}") from refusal
    promised, wish = calibration.accuracy, known.wanted.accuracy
    bound = known.bound_mm if promised is None or promised.bound_95_mm is None else promised.bound_95_mm
    if bound is None or not np.isfinite(bound):
        raise NotApplicable(f"Run {run} has no error map: its position error has no finite bound.")
    x, y = _axes(known.robot)
    places = (x[None, :] + 1j * y[:, None]).ravel()
    open_to = _open_to(known.robot, places, joints)
    if not open_to.any():
        raise NotApplicable(f"Run {run} has no error map: no joint may be sent into the workspace.")
    fields = known.fields(places[open_to])

    def grid(values: Real) -> tuple[tuple[float | None, ...], ...]:
        return _rows(values, open_to, len(x))

    return ErrorMap(
        x_mm=tuple(x.tolist()),
        y_mm=tuple(y.tolist()),
        before_mm=grid(fields.before),
        after_mm=grid(fields.after),
        after_95_mm=grid(fields.within(bound)),
        bound_95_mm=bound,
        limit_mm=known.robot.accuracy_mm if wish is None else wish.wanted_mm,
        fresh=known.fresh,
    )


def _of_calibration(store: Store, calibration: Calibration) -> _Known:
    source = source_of(store, calibration.id)
    zeros = np.radians(source.offsets_deg)
    if not source.fresh:
        fresh: tuple[FreshReading, ...] = ()
    elif calibration.plan == "paper":
        residual_mm = _published_residual(store, source)
        fresh = fresh_readings(source.fit, from_readings(list(source.fresh)), residual_mm)
    else:
        later = _measurements(source)
        fresh = fresh_readings(source.fit, later, verify(source.fit, later).residual_mm)
    return _known(source, calibration, zeros, fresh)


def _of_application(store: Store, calibration: Calibration) -> _Known:
    """The values that the run left in the drives, not those that it intended to write."""
    assert calibration.of is not None
    source, applied = source_of(store, calibration.of), store.calibration(calibration.of)
    writes = store.zero_writes(calibration.robot_serial, since=calibration.of)
    shift = np.radians(shift_of([write for write in writes if write.run_id <= calibration.id]))
    taken = [r for r in store.readings(calibration.id) if r.sequence > 1]
    if not taken or calibration.verdict != "pass":  # zeros that were rolled back differed when it measured
        return _known(source, applied, -shift, ())
    moved = source.fit.moved((float(np.degrees(shift[0])), float(np.degrees(shift[1]))))
    later = from_readings(taken, source.fit.measurements.mounts)
    residual_mm = verify(moved, later, offset_known=False).residual_mm
    return _known(source, applied, -shift, fresh_readings(moved, later, residual_mm))


def _known(source: Source, wanted: Calibration, zeros: Real, fresh: tuple[FreshReading, ...]) -> _Known:
    return _Known(
        robot=source.fit.mechanism.robot,
        wanted=wanted,
        fields=lambda places: error_fields(source.fit, zeros, places),
        bound_mm=bounds_mm(source.fit, zeros)[0],
        fresh=fresh,
    )


def _of_diagnosis(store: Store, calibration: Calibration) -> _Known:
    robot = robot_as_measured(store, calibration)
    findings = diagnosed(robot, store.readings(calibration.id))

    def fields(places: Complex) -> ErrorFields:
        known = findings.error_fields(places)
        assert known is not None  # a five-bar always has it
        return known

    return _Known(robot, calibration, fields, findings.zeros_only_bound_mm, findings.fresh)


_BY_KIND: dict[str, Callable[[Store, Calibration], _Known]] = {
    "calibrate": _of_calibration,
    "apply": _of_application,
    "diagnose": _of_diagnosis,
    "separate": _of_diagnosis,
    "import": _of_diagnosis,
}


def _measurements(source: Source) -> Measurements:
    return from_readings(list(source.fresh), source.fit.measurements.mounts)


def _published_residual(store: Store, source: Source) -> Real:
    """(K,) fresh readings less the prediction of the published method, mm."""
    run = PublishedRun(source.fit.mechanism.robot)
    fresh = {reading.reading for reading in source.fresh}
    readings = [r for r in store.readings(source.id) if r.reading not in fresh]
    for number in sorted({r.sequence for r in readings}):
        run.absorb([r for r in readings if r.sequence == number])
    return run.predicted(list(source.fresh))[0]


def _axes(robot: Robot) -> tuple[Real, Real]:
    """x and y of the grid, mm, with about equal steps in both directions."""
    spans = [high - low for low, high in (robot.workspace_x, robot.workspace_y)]
    step = max(spans) / STEPS
    counts = [max(round(span / step), 1) + 1 for span in spans]
    x, y = (
        np.round(np.linspace(*ends, count), DIGITS)
        for ends, count in zip((robot.workspace_x, robot.workspace_y), counts, strict=True)
    )
    return x, y


def _open_to(robot: Robot, places: Complex, joints: Sequence[JointSettings]) -> Flags:
    """(G,) whether both joints stay inside their limits."""
    middle, reach = np.array([(joint.zero_at_deg, joint.reach_deg) for joint in joints]).T
    off = np.abs(np.degrees(inverse(robot.geometry, places)) - middle)
    return np.asarray((off <= reach).all(axis=1))


def _rows(values: Real, where: Flags, width: int) -> tuple[tuple[float | None, ...], ...]:
    """Values (N,) of the reachable positions, row by row; null for the others."""
    everywhere = np.full(len(where), np.nan)
    everywhere[where] = np.round(values, DIGITS)
    cells = [None if np.isnan(value) else float(value) for value in everywhere]
    return tuple(tuple(cells[k : k + width]) for k in range(0, len(cells), width))
