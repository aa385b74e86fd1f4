"""Zero offsets written to the drives, verified at fresh positions, rolled back when that fails.

Before anything is written a few fresh readings show that the machine is still the one that was calibrated.
The model of that calibration stays fixed; only the frame of its angles moves, by the values written to the
drives. The readout may have been switched off since, so its offset is free.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import Any, Literal

from drivers.errors import DeviceError
from station.errors import InputRefused, StepFailed
from station.five_bar import FiveBar
from station.identification import Identification, Verification, fresh_stops, prediction_fault, verify
from station.motion import shift_of
from station.records import (
    LIMIT_SDS,
    Accuracy,
    Angles,
    Beforehand,
    CalibrationResult,
    MeasurementSequence,
    Procedure,
    Reading,
    Reason,
    SetZeros,
    because,
    from_readings,
    residual_rows,
)
from station.run_kinds.adaptive import fit_in_sequence
from station.run_kinds.calibrate import passes_apart
from station.run_kinds.fits import fit_of
from station.run_kinds.kind import RunKind, Start, register, robot_as_measured
from station.run_kinds.zero_state import check_apply, check_roll_back, rolled_back_by
from station.store import Store

CHECK_PLACES = 4
OLD_ZEROS = (0.0, 0.0)

_Steps = Generator[MeasurementSequence | SetZeros, Any, Angles]
_Measured = Generator[MeasurementSequence | SetZeros, Any, tuple[list[Reading], Verification]]


@dataclass(frozen=True)
class Source:
    """A passed calibration: its fixed model, and the offsets of its result."""

    id: int
    fit: Identification[FiveBar]
    offsets_deg: Angles
    fresh: tuple[Reading, ...] = ()
    """Readings that verified it: they were not used in the fit."""


def source_of(store: Store, calibration_id: int) -> Source:
    """Fitted again from the stored readings, with the memory that was used then.

    :raises NotFound: no such calibration.
    :raises InputRefused: its readings do not satisfy the measurement model.
    """
    calibration = store.calibration(calibration_id)
    everything = store.readings(calibration_id)
    if calibration.plan == "paper":
        verified = calibration.after is not None and calibration.after.fresh_reading_rms_mm is not None
        last = everything[-1].sequence if verified else None
        fresh = [r for r in everything if r.sequence == last]
        # a position's passes have different angles: they are no repeats
        readings = passes_apart([r for r in everything if r.sequence != last])
    else:  # the second sequence verified
        readings = [r for r in everything if r.sequence == 1]
        fresh = [r for r in everything if r.sequence > 1]
    use = calibration.memory
    memory: Beforehand | None = store.memory_left_by(use.from_calibration) if use and use.used else None
    if calibration.fleet is not None and calibration.fleet.used:
        memory = calibration.fleet.prior
    refit = fit_in_sequence if calibration.plan == "adaptive" else fit_of
    robot = robot_as_measured(store, calibration)
    fit = refit(robot, readings, memory, (use.age_days if use else None) or 0.0)
    offsets = [zero.value_deg for zero in calibration.zero_offsets if zero.value_deg is not None]
    if len(offsets) != 2:
        raise InputRefused(f"Run {calibration_id} has no zero offsets; calibrate again.")
    return Source(calibration_id, fit, (offsets[0], offsets[1]), tuple(fresh))


def start_apply(start: Start) -> Procedure:
    """The procedure that applies a calibration, not yet started."""
    return apply(source_of(start.store, start.of))


def start_roll_back(start: Start) -> Procedure:
    """The procedure that rolls a calibration back, not yet started."""
    source = source_of(start.store, start.of)
    verified = any(run.verdict == "pass" for run in start.store.runs_of(source.id))
    writes = start.store.zero_writes(start.request.robot_serial, since=source.id)
    return roll_back(source, shift_of(writes) if verified else None)


def apply(source: Source) -> Procedure:
    """Check, write, verify; any failure after the first zero was written rolls them back."""
    doubt = prediction_fault((yield from _measured(source.fit, "Checking the machine", 1, CHECK_PLACES))[1])
    if doubt:
        raise StepFailed(
            f"Nothing was written: the machine is not as run {source.id} measured it. {doubt.text}"
            " Calibrate again."
        )
    try:
        shift: Angles = yield SetZeros("Writing the zero offsets", 2, source.id, source.offsets_deg)
        fit = source.fit.moved(shift)
        readings, check = yield from _measured(fit, "Verifying at fresh positions", 3)
    except (DeviceError, StepFailed) as error:
        yield from _way_back(source, str(error))
        raise StepFailed(f"{error} The old zero offsets are in the drives.") from error
    if doubt := prediction_fault(check):
        shift = yield from _way_back(source, doubt.text)
        undone = because("rolled_back_after", text=doubt.text)
        return _result(source, shift, "not_verified", undone, readings, check)
    return _result(source, shift, "good", because("verified", rms_um=check.rms_mm * 1e3), readings, check)


def roll_back(source: Source, verified_shift: Angles | None) -> Procedure:
    """Restore the previous zeros.

    :param verified_shift: the shift that a verified application wrote and the drives must still have.
    """
    readings: list[Reading] = []
    check = None
    if verified_shift is not None:
        fit = source.fit.moved(verified_shift)
        readings, check = yield from _measured(fit, "Checking the machine", 1, CHECK_PLACES)
        if doubt := prediction_fault(check):
            raise StepFailed(
                f"Nothing was written: the drives are not as they were left. {doubt.text} Calibrate again."
            )
    shift: Angles = yield SetZeros("Rolling back", 2, source.id, OLD_ZEROS)
    return _result(source, shift, "good", because("rolled_back"), readings, check)


def _measured(fit: Identification[FiveBar], title: str, number: int, count: int | None = None) -> _Measured:
    """Fresh readings compared with a model."""
    stops = fresh_stops(fit, seed=number) if count is None else fresh_stops(fit, count, number, "C")
    readings: list[Reading] = yield MeasurementSequence(title, number, stops, last=True)
    fresh = from_readings(readings, fit.measurements.mounts)
    return readings, verify(fit, fresh, offset_known=False)


def _way_back(source: Source, cause: str) -> _Steps:
    try:
        shift: Angles = yield SetZeros("Rolling back", 4, source.id, OLD_ZEROS)
    except (DeviceError, StepFailed) as error:
        raise StepFailed(f"{cause} The way back failed too: {error}") from error
    return shift


def _result(
    source: Source,
    shift: Angles,
    outcome: Literal["good", "not_verified"],
    reason: Reason,
    readings: list[Reading],
    check: Verification | None,
) -> CalibrationResult:
    """The remaining zero offsets in the drives as they now count, and how well that was confirmed."""
    fit = source.fit.moved(shift)
    quantities = fit.quantities()
    return CalibrationResult(
        verdict="pass" if outcome == "good" else "fail",
        outcome=outcome,
        reason=reason,
        method=f"zero offsets of run {source.id}",
        zero_offsets=quantities[:2],
        parameters=quantities[2:],
        weak_direction=fit.weak_direction,
        before=Accuracy(predicted_position_error_mm=source.fit.position_error(compensated=False)),
        after=Accuracy(
            reading_rms_mm=None if check is None else check.rms_mm,
            predicted_position_error_mm=fit.position_error(compensated=False),
        ),
        residuals=()
        if check is None
        else residual_rows(readings, check.residual_mm, LIMIT_SDS * check.sd_mm),
    )


APPLY = register(RunKind("apply", start_apply, check=check_apply, rests_on_scale=False))
ROLL_BACK = register(
    RunKind("rollback", start_roll_back, check=check_roll_back, done_by=rolled_back_by, rests_on_scale=False)
)
