"""A failed check locks work with the calibration: its commands and offsets are no longer valid."""

from __future__ import annotations

from station.errors import NotApplicable
from station.records import CalibrationHolds, CalibrationSummary
from station.run_kinds.kind import has_offsets
from station.store import Store

CLEARED = "check_cleared"
MOST_LOOKED_AT = 500


def calibration_holds(store: Store, serial: str) -> CalibrationHolds:
    """Whether work with the calibration of a robot is permitted, from its checks and calibrations."""
    newest = _newest(store, serial)
    if newest is None:
        return CalibrationHolds(robot_serial=serial, locked=False, text="Not checked yet.")
    if newest.verdict == "fail":
        return CalibrationHolds(
            robot_serial=serial,
            locked=True,
            text=f"Locked: check {newest.id} failed. {newest.reason} An engineer can clear it.",
            check=newest.id,
        )
    found = store.calibration(newest.id).check
    until = found.valid_until if found else None
    return CalibrationHolds(
        robot_serial=serial,
        locked=False,
        text=f"Check {newest.id} passed.",
        check=newest.id,
        calibration_valid_until=until,
    )


def _newest(store: Store, serial: str) -> CalibrationSummary | None:
    """The failed check that is still in force, otherwise the last passed one; None without either.

    A failed check is in force until a calibration has passed, the one that had found its shift is applied, or
    a person has cleared it; a check that passes later does not clear it.
    """
    passed = None
    applied: set[int] = set()
    for run in store.calibrations(limit=MOST_LOOKED_AT, robot_serial=serial).items:
        if run.verdict == "pass" and has_offsets(run):
            return passed
        if run.kind == "check" and run.verdict == "pass" and passed is None:
            passed = run
        if run.kind == "apply" and run.verdict == "pass" and run.of is not None:
            applied.add(run.of)
        if run.kind == "check" and run.verdict == "fail":
            explained = bool(applied) and _known_by(store, run.id) in applied
            if not explained and not _cleared(store, run.id):
                return run
    return passed


def check_not_locked(store: Store, calibration_id: int) -> None:
    """:raises NotApplicable: a check after this run has failed; :raises NotFound: no such run."""
    run = store.summary(calibration_id)
    holds = calibration_holds(store, run.robot_serial)
    if holds.locked and holds.check is not None and holds.check > calibration_id:
        if _known_by(store, holds.check) == calibration_id:
            return
        raise NotApplicable(f"{holds.text} Run {calibration_id} was made before it: calibrate again.")


def clear_failed_check(store: Store, serial: str, who: str, reason: str) -> None:
    """Permit work with the calibration again; the person and the reason are recorded.

    :raises NotFound: no such robot.
    :raises NotApplicable: nothing is locked.
    """
    holds = calibration_holds(store, serial)
    if not holds.locked or holds.check is None:
        store.robot(serial)
        raise NotApplicable(f"Nothing is locked for robot {serial}.")
    store.add_event(holds.check, CLEARED, {"by": who, "reason": reason})


def _known_by(store: Store, check_id: int) -> int | None:
    """The calibration that has found the shift of a failed check."""
    found = store.calibration(check_id).check
    return found.known_by if found else None


def _cleared(store: Store, check_id: int) -> bool:
    return any(event.kind == CLEARED for event in store.events(check_id))
