"""The state of a calibration's zero offsets: written to the drives, verified, rolled back, or in doubt.

It is derived from the journal of zeros alone, so it is also correct after an abort, a crash or a power
failure.
"""

from __future__ import annotations

from collections.abc import Callable

from station.errors import NotApplicable
from station.messages import display_name
from station.records import (
    Application,
    ApplicationRun,
    ApplicationState,
    CalibrationRequest,
    CalibrationSummary,
    JointApplication,
    ZeroOffset,
    ZeroWrite,
)
from station.run_kinds.kind import RUN_KINDS, has_offsets
from station.run_kinds.lock import check_not_locked
from station.store import Store

_TEXTS: dict[ApplicationState, str] = {
    "unwritten": "The drives hold the old zero offsets.",
    "applied": "The drives hold these zero offsets.",
    "partly": "One drive holds its new zero offset, the other does not.",
    "in doubt": "It is unknown whether a drive accepted its new zero. The next run will check.",
    "superseded": "The zeros of the drives have been changed since, for another run.",
    "rolled back": "Rolled back: the drives hold the old zero offsets again.",
}


def application(store: Store, calibration: CalibrationSummary) -> Application | None:
    """The part of a calibration that the drives have; None where there is nothing to apply."""
    if calibration.verdict != "pass" or not has_offsets(calibration):
        return None
    runs = store.runs_of(calibration.id)
    writes = _writes(store, calibration)
    joints = tuple(_joint(zero, writes) for zero in calibration.zero_offsets)
    own = all(write.of == calibration.id for write in writes)
    state = _state({joint.state for joint in joints}) if own else "superseded"
    verified = state == "applied" and any(r.kind == "apply" and r.verdict == "pass" for r in runs)
    return Application(
        state=state,
        verified=verified,
        text=_TEXTS[state],
        joints=joints,
        runs=tuple(ApplicationRun.model_validate(dict(run)) for run in runs),
        apply_refused=_reason(store, calibration.id, _check_apply),
        rollback_refused=_reason(store, calibration.id, _check_roll_back),
    )


def check_apply(store: Store, request: CalibrationRequest) -> None:
    """:raises NotApplicable: with the reason; :raises NotFound: no such run."""
    _check_apply(store, request.of or 0)


def check_roll_back(store: Store, request: CalibrationRequest) -> None:
    """:raises NotApplicable: with the reason; :raises NotFound: no such run."""
    _check_roll_back(store, request.of or 0)


def _check_apply(store: Store, calibration_id: int) -> None:
    calibration = _applicable(store, calibration_id)
    check_not_locked(store, calibration_id)
    serial = calibration.robot_serial
    if store.robot_of(calibration_id).to_json() != store.robot(serial).to_json():
        raise NotApplicable(f"The file of robot {serial} has changed since this run; calibrate again.")
    writes = [write for write in _writes(store, calibration) if write.taken is not False]
    if writes:
        _check_not_superseded(calibration_id, writes)
        raise NotApplicable(
            f"Run {calibration_id} has been applied by run {writes[0].run_id}; calibrate to apply again."
        )


def _check_roll_back(store: Store, calibration_id: int) -> None:
    calibration = _applicable(store, calibration_id)
    writes = _writes(store, calibration)
    _check_not_superseded(calibration_id, writes)
    state = _state({_joint(zero, writes).state for zero in calibration.zero_offsets})
    if state in ("unwritten", "rolled back"):
        raise NotApplicable(f"{_TEXTS[state]} There is nothing to roll back.")


def rolled_back_by(store: Store, calibration_id: int) -> int | None:
    """The run that restored the old zeros and was the last to write any; None without one."""
    calibration = store.summary(calibration_id)
    known = application(store, calibration)
    if known is None or known.state != "rolled back":
        return None
    return _writes(store, calibration)[-1].run_id


def _applicable(store: Store, calibration_id: int) -> CalibrationSummary:
    calibration = store.summary(calibration_id)
    if calibration.of is not None:
        raise NotApplicable(f"Run {calibration_id} is no calibration; it belongs to run {calibration.of}.")
    if not has_offsets(calibration):
        known = calibration.kind in RUN_KINDS
        kind = display_name("run_kinds", calibration.kind).lower() if known else calibration.kind
        raise NotApplicable(
            f"Run {calibration_id} is of kind {kind}, not a calibration; calibrate to have offsets to write."
        )
    if calibration.state != "succeeded" or calibration.verdict != "pass":
        raise NotApplicable(f"Run {calibration_id} has not passed; only the offsets of a pass are written.")
    return calibration


def _writes(store: Store, calibration: CalibrationSummary) -> list[ZeroWrite]:
    return store.zero_writes(calibration.robot_serial, since=calibration.id)


def _check_not_superseded(calibration_id: int, writes: list[ZeroWrite]) -> None:
    for write in writes:
        if write.of != calibration_id:
            raise NotApplicable(f"The zeros of the drives have been changed since, by run {write.run_id}.")


def _reason(store: Store, calibration_id: int, check: Callable[[Store, int], None]) -> str | None:
    try:
        check(store, calibration_id)
    except NotApplicable as refusal:
        return str(refusal)
    return None


def _joint(zero: ZeroOffset, all_writes: list[ZeroWrite]) -> JointApplication:
    writes = [write for write in all_writes if write.joint == zero.joint]
    shifts = [write.shift_deg for write in writes]
    known = [shift for shift in shifts if shift is not None]
    shift_deg = sum(known) if len(known) == len(shifts) else None
    old_deg = zero.value_deg or 0.0
    return JointApplication(
        joint=zero.joint,
        state=_joint_state(writes),
        old_offset_deg=old_deg,
        shift_deg=shift_deg,
        new_offset_deg=None if shift_deg is None else old_deg + shift_deg,
    )


def _joint_state(writes: list[ZeroWrite]) -> ApplicationState:
    if any(write.taken is None for write in writes):
        return "in doubt"
    taken = [write for write in writes if write.taken]
    if not taken:
        return "unwritten"
    return "applied" if taken[-1].offset_deg else "rolled back"


def _state(joints: set[ApplicationState]) -> ApplicationState:
    if "in doubt" in joints:
        return "in doubt"
    if "applied" in joints:
        return "applied" if joints == {"applied"} else "partly"
    return "rolled back" if "rolled back" in joints else "unwritten"
