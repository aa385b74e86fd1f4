"""Zero offsets written to the drives, verified at fresh places, taken back when that fails.

Before anything is written a few fresh readings show that the machine is still the one that was
calibrated.  The model of that calibration stays frozen; only the frame of its angles moves, by what
the drives were told.  The readout may have been switched off since, so its offset is left open.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace
from typing import Any, Literal

from drivers.errors import DeviceError
from station.errors import StepFailed, sentence
from station.identification import (
    LIMIT_SDS,
    Identification,
    Verification,
    fresh_stops,
    prediction_fault,
    verify,
    weak_direction_of,
)
from station.motion import shift_of
from station.records import (
    Angles,
    CalibrationRequest,
    CalibrationResult,
    Procedure,
    Reading,
    SetZeros,
    Walk,
    from_readings,
)
from station.run_kinds.calibrate import fit_of
from station.store import Store

CHECK_PLACES = 4
OLD_ZEROS = (0.0, 0.0)

_Steps = Generator[Walk | SetZeros, Any, Angles]
_Measured = Generator[Walk | SetZeros, Any, tuple[list[Reading], Verification]]


@dataclass(frozen=True)
class Source:
    """A passed calibration: its frozen model, and the offsets that its result states."""

    id: int
    fit: Identification
    offsets_deg: Angles


def source_of(store: Store, calibration_id: int) -> Source:
    """Fitted again from the stored readings, with the memory that took part then.

    :raises NotFound: no such calibration.
    :raises InputRefused: its readings do not hold the measurement model.
    """
    calibration = store.calibration(calibration_id)
    readings = store.readings(calibration_id)
    if calibration["plan"] == "paper":  # a place's passes stand at different angles: they are no repeats
        readings = [replace(r, position=f"{r.position} pass {r.walk}") for r in readings]
    else:  # the second walk verified, it took no part in the fit
        readings = [r for r in readings if r.walk == 1]
    use = calibration["memory"] or {"used": False, "age_days": 0.0}
    memory = store.memory_left_by(use["from_calibration"]) if use["used"] else None
    fit = fit_of(store.robot_of(calibration_id), readings, memory, use["age_days"])
    first, second = (zero["value_deg"] for zero in calibration["zero_offsets"])
    return Source(calibration_id, fit, (first, second))


def start_application(store: Store, request: CalibrationRequest) -> Procedure:
    """The procedure of a request to apply or roll back a calibration, not yet started."""
    assert request.of is not None
    source = source_of(store, request.of)
    if request.plan == "apply":
        return apply(source)
    verified = any(run["verdict"] == "pass" for run in store.runs_of(source.id))
    writes = store.zero_writes(request.robot_serial, since=source.id)
    return roll_back(source, shift_of(writes) if verified else None)


def apply(source: Source) -> Procedure:
    """Check, write, verify; whatever fails after the first zero was written takes them back."""
    doubt = prediction_fault((yield from _measured(source.fit, "Checking the machine", 1, CHECK_PLACES))[1])
    if doubt:
        raise StepFailed(
            f"Nothing was written: the machine is not as run {source.id} measured it, {doubt}."
            " Calibrate again."
        )
    try:
        shift: Angles = yield SetZeros("Writing the zero offsets", 2, source.id, source.offsets_deg)
        fit = source.fit.moved(shift)
        readings, check = yield from _measured(fit, "Verifying at fresh places", 3)
    except (DeviceError, StepFailed) as error:
        yield from _way_back(source, str(error))
        raise StepFailed(f"{error} The old zero offsets are in the drives.") from error
    if doubt := prediction_fault(check):
        shift = yield from _way_back(source, sentence(f"{doubt}."))
        text = f"{doubt}; rolled back, the old zero offsets are in the drives"
        return _result(source, shift, "fail", text, readings, check)
    text = f"verified: fresh readings agree within {check.rms_mm * 1e3:.1f} um"
    return _result(source, shift, "pass", text, readings, check)


def roll_back(source: Source, verified_shift: Angles | None) -> Procedure:
    """Take the zeros back.

    :param verified_shift: what a verified application left behind and the drives must still hold.
    """
    readings: list[Reading] = []
    check = None
    if verified_shift is not None:
        fit = source.fit.moved(verified_shift)
        readings, check = yield from _measured(fit, "Checking the machine", 1, CHECK_PLACES)
        if doubt := prediction_fault(check):
            raise StepFailed(
                f"Nothing was written: the drives are not as they were left, {doubt}. Calibrate again."
            )
    shift: Angles = yield SetZeros("Rolling back", 2, source.id, OLD_ZEROS)
    return _result(source, shift, "pass", "the old zero offsets are in the drives", readings, check)


def _measured(fit: Identification, title: str, number: int, count: int | None = None) -> _Measured:
    """Fresh readings and what they say about a model."""
    stops = fresh_stops(fit, seed=number) if count is None else fresh_stops(fit, count, number, "C")
    readings: list[Reading] = yield Walk(title, number, stops)
    return readings, verify(fit, from_readings(readings), offset_known=False)


def _way_back(source: Source, cause: str) -> _Steps:
    try:
        shift: Angles = yield SetZeros("Rolling back", 4, source.id, OLD_ZEROS)
    except (DeviceError, StepFailed) as error:
        raise StepFailed(f"{cause} The way back failed too: {error}") from error
    return shift


def _result(
    source: Source,
    shift: Angles,
    verdict: Literal["pass", "fail"],
    reason: str,
    readings: list[Reading],
    check: Verification | None,
) -> CalibrationResult:
    """What is left of the offsets in the drives as they now count, and how well that was confirmed."""
    fit = source.fit.moved(shift)
    quantities = fit.quantities()
    residuals = () if check is None else zip(readings, check.residual_mm, check.sd_mm, strict=True)
    return CalibrationResult(
        verdict=verdict,
        reason=reason,
        method=f"zero offsets of run {source.id}",
        zero_offsets=quantities[:2],
        parameters=quantities[2:],
        weak_direction=weak_direction_of(fit),
        before={"predicted_position_error_mm": source.fit.position_error(compensated=False)},
        after={
            "reading_rms_mm": None if check is None else check.rms_mm,
            "predicted_position_error_mm": fit.position_error(compensated=False),
        },
        iterations=(),
        residuals=tuple(
            {
                "reading": reading.reading,
                "position": reading.position,
                "residual_mm": float(residual),
                "limit_mm": LIMIT_SDS * float(sd),
            }
            for reading, residual, sd in residuals
        ),
    )
