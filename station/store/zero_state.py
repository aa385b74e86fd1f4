"""What has become of a calibration's zero offsets: written to the drives, verified, rolled back, or in doubt.

Told from the journal of zeros alone, so that it is right after an abort, a crash or a power cut too.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from station.errors import NotApplicable
from station.records import ZeroWrite
from station.store.store import Store

_TEXTS = {
    "unwritten": "The drives hold the old zero offsets.",
    "applied": "The drives hold these zero offsets.",
    "partly": "One drive holds its new zero offset, the other does not.",
    "in doubt": "Whether a drive took its new zero is not known; the next run looks.",
    "superseded": "The zeros of the drives have been changed since, for another run.",
    "rolled back": "Rolled back: the drives hold the old zero offsets again.",
}

_NO_CALIBRATION = {"diagnostic": "looked for a cause", "dataset": "was imported from a file"}


def application(store: Store, calibration: dict[str, Any]) -> dict[str, Any] | None:
    """The `application` part of a calibration as REST answers it; None where there is nothing to apply."""
    if calibration["of"] is not None or calibration["verdict"] != "pass":
        return None
    if calibration["plan"] in _NO_CALIBRATION:
        return None
    runs = store.runs_of(calibration["id"])
    writes = _writes(store, calibration)
    joints = [_joint(zero, writes) for zero in calibration["zero_offsets"]]
    own = all(write.of == calibration["id"] for write in writes)
    state = _state([joint["state"] for joint in joints]) if own else "superseded"
    verified = state == "applied" and any(r["plan"] == "apply" and r["verdict"] == "pass" for r in runs)
    return {
        "state": state,
        "verified": verified,
        "text": _TEXTS[state],
        "joints": joints,
        "runs": [
            {key: run[key] for key in ("id", "plan", "operator", "state", "verdict", "reason", "ended_at")}
            for run in runs
        ],
        "apply_refused": _reason(store, calibration["id"], check_apply),
        "rollback_refused": _reason(store, calibration["id"], check_roll_back),
    }


def check_apply(store: Store, calibration_id: int) -> None:
    """:raises NotApplicable: saying why; :raises NotFound: no such run."""
    calibration = _applicable(store, calibration_id)
    serial = calibration["robot_serial"]
    if store.robot_of(calibration_id).to_json() != store.robot(serial).to_json():
        raise NotApplicable(f"The file of robot {serial} has changed since this run; calibrate again.")
    writes = [write for write in _writes(store, calibration) if write.taken is not False]
    if writes:
        _check_not_superseded(calibration_id, writes)
        raise NotApplicable(
            f"Run {calibration_id} has been applied by run {writes[0].run_id}; calibrate to apply again."
        )


def check_roll_back(store: Store, calibration_id: int) -> None:
    """:raises NotApplicable: saying why; :raises NotFound: no such run."""
    calibration = _applicable(store, calibration_id)
    writes = _writes(store, calibration)
    _check_not_superseded(calibration_id, writes)
    state = _state([_joint(zero, writes)["state"] for zero in calibration["zero_offsets"]])
    if state in ("unwritten", "rolled back"):
        raise NotApplicable(f"{_TEXTS[state]} There is nothing to roll back.")


def rolled_back_by(store: Store, calibration_id: int) -> int | None:
    """The run that put the old zeros back and was the last to write any; None when there is none."""
    calibration = store.calibration(calibration_id)
    known = application(store, calibration)
    if known is None or known["state"] != "rolled back":
        return None
    return _writes(store, calibration)[-1].run_id


def _applicable(store: Store, calibration_id: int) -> dict[str, Any]:
    calibration = store.calibration(calibration_id)
    if calibration["of"] is not None:
        raise NotApplicable(f"Run {calibration_id} is no calibration; it belongs to run {calibration['of']}.")
    if calibration["plan"] in _NO_CALIBRATION:
        what = _NO_CALIBRATION[calibration["plan"]]
        raise NotApplicable(f"Run {calibration_id} {what}; calibrate to have offsets to write.")
    if calibration["state"] != "succeeded" or calibration["verdict"] != "pass":
        raise NotApplicable(f"Run {calibration_id} has not passed; only the offsets of a pass are written.")
    return calibration


def _writes(store: Store, calibration: dict[str, Any]) -> list[ZeroWrite]:
    return store.zero_writes(calibration["robot_serial"], since=calibration["id"])


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


def _joint(zero: dict[str, Any], all_writes: list[ZeroWrite]) -> dict[str, Any]:
    writes = [write for write in all_writes if write.joint == zero["joint"]]
    shifts = [write.shift_deg for write in writes]
    known = [shift for shift in shifts if shift is not None]
    shift_deg = sum(known) if len(known) == len(shifts) else None
    return {
        "joint": zero["joint"],
        "state": _joint_state(writes),
        "old_offset_deg": zero["value_deg"],
        "shift_deg": shift_deg,
        "new_offset_deg": None if shift_deg is None else zero["value_deg"] + shift_deg,
    }


def _joint_state(writes: list[ZeroWrite]) -> str:
    if any(write.taken is None for write in writes):
        return "in doubt"
    taken = [write for write in writes if write.taken]
    if not taken:
        return "unwritten"
    return "applied" if taken[-1].offset_deg else "rolled back"


def _state(joints: list[str]) -> str:
    if "in doubt" in joints:
        return "in doubt"
    if "applied" in joints:
        return "applied" if set(joints) == {"applied"} else "partly"
    return "rolled back" if "rolled back" in joints else "unwritten"
