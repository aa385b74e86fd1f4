"""What the journal of zeros tells of a calibration: each state, each refusal, joint by joint."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from station.errors import NotApplicable
from station.five_bar.robot_file import Robot
from station.records import Application, Quantity, State
from station.run_kinds.zero_state import (
    application,
    check_apply,
    check_roll_back,
    rolled_back_by,
)
from station.store.store import Store
from tests.station.asking import asked, result

ROBOT = Robot.default("R1")
HOME = (0.0, 180.0)
OFFSETS = (0.5, -0.25)
RESULT = result(
    zero_offsets=(Quantity("dtheta1", OFFSETS[0], 0.1, "deg"), Quantity("dtheta2", OFFSETS[1], 0.1, "deg"))
)


class History:
    """One calibration and what is done with its zeros."""

    def __init__(self, store: Store) -> None:
        self.store = store
        self.run = self.calibrated()

    def calibrated(self) -> int:
        run = self.store.create(asked("R1", "rapid"), ROBOT)
        self.store.finish(run, State.SUCCEEDED, RESULT)
        return run

    def writing(
        self, kind: str = "apply", of: int | None = None, verdict: str = "pass", joints: str = "12"
    ) -> int:
        """A run that writes or takes back; "1" only the first joint, "?" leaves open, "x" was refused."""
        of = of or self.run
        run = self.store.create(asked("R1", kind, of=of), ROBOT)
        for joint, mark in zip((1, 2), joints.ljust(2), strict=True):
            if mark == " ":
                continue
            taken = OFFSETS[joint - 1] if kind == "apply" else 0.0
            moved = -OFFSETS[joint - 1] if kind == "apply" else OFFSETS[joint - 1]
            write = self.store.begin_zero_write(run, joint, taken, HOME[joint - 1] + moved)
            if mark != "?":
                self.store.end_zero_write(write, None if mark == "x" else HOME[joint - 1])
        self.store.finish(run, State.SUCCEEDED, RESULT.model_copy(update={"verdict": verdict}))
        return run

    def known(self, run: int | None = None) -> Application:
        found = application(self.store, self.store.summary(run or self.run))
        assert found is not None
        return found


@pytest.fixture
def history(store: Store) -> History:
    return History(store)


def refusal(check: Callable[..., None], history: History, run: int | None = None) -> str | None:
    try:
        check(history.store, asked("R1", "apply", of=run or history.run))
    except NotApplicable as refused:
        return str(refused)
    return None


def test_nothing_written_yet(history: History) -> None:
    known = history.known()
    assert (known.state, known.verified, known.runs) == ("unwritten", False, ())
    assert known.text == "The drives hold the old zero offsets."
    assert known.apply_refused is None
    assert known.rollback_refused == "The drives hold the old zero offsets. There is nothing to roll back."
    assert [joint.model_dump() for joint in known.joints] == [
        {"joint": 1, "state": "unwritten", "old_offset_deg": 0.5, "shift_deg": 0.0, "new_offset_deg": 0.5},
        {
            "joint": 2,
            "state": "unwritten",
            "old_offset_deg": -0.25,
            "shift_deg": 0.0,
            "new_offset_deg": -0.25,
        },
    ]
    assert rolled_back_by(history.store, history.run) is None


def test_applied_and_verified(history: History) -> None:
    run = history.writing()
    known = history.known()
    assert (known.state, known.verified) == ("applied", True)
    assert known.text == "The drives hold these zero offsets."
    assert known.apply_refused == (
        f"Run {history.run} has been applied by run {run}; calibrate to apply again."
    )
    assert known.rollback_refused is None
    assert [(j.state, j.shift_deg, j.new_offset_deg) for j in known.joints] == [
        ("applied", -0.5, 0.0),
        ("applied", 0.25, 0.0),
    ]
    (attempt,) = known.runs
    stored = history.store.summary(run)
    assert (attempt.id, attempt.plan, attempt.operator) == (run, "apply", "ada")
    assert (attempt.state, attempt.verdict, attempt.reason) == (State.SUCCEEDED, "pass", stored.reason)
    assert attempt.ended_at == stored.ended_at is not None
    assert rolled_back_by(history.store, history.run) is None


def test_applied_but_not_verified(history: History) -> None:
    history.writing(verdict="fail")
    assert (history.known().state, history.known().verified) == ("applied", False)


def test_a_passed_rollback_verifies_no_application(history: History) -> None:
    history.writing(verdict="fail")
    history.writing("rollback", joints="")
    assert (history.known().state, history.known().verified) == ("applied", False)


@pytest.mark.parametrize(
    ("joints", "state", "states", "shifts"),
    [
        ("1", "partly", ("applied", "unwritten"), (-0.5, 0.0)),
        (" 2", "partly", ("unwritten", "applied"), (0.0, 0.25)),
        ("1x", "partly", ("applied", "unwritten"), (-0.5, 0.0)),
        ("xx", "unwritten", ("unwritten", "unwritten"), (0.0, 0.0)),
        ("1?", "in doubt", ("applied", "in doubt"), (-0.5, None)),
        ("?", "in doubt", ("in doubt", "unwritten"), (None, 0.0)),
    ],
)
def test_half_an_application(
    history: History,
    joints: str,
    state: str,
    states: tuple[str, str],
    shifts: tuple[float | None, float | None],
) -> None:
    run = history.writing(joints=joints, verdict="fail")
    known = history.known()
    assert (known.state, known.verified) == (state, False)
    assert tuple(joint.state for joint in known.joints) == states
    assert tuple(joint.shift_deg for joint in known.joints) == shifts
    assert tuple(joint.new_offset_deg for joint in known.joints) == tuple(
        None if shift is None else offset + shift for offset, shift in zip(OFFSETS, shifts, strict=True)
    )
    if state == "unwritten":
        assert known.apply_refused is None
        assert known.rollback_refused is not None
    else:
        assert known.rollback_refused is None
        assert known.apply_refused is not None and f"applied by run {run}" in known.apply_refused


TEXTS = {
    "1": "One drive holds its new zero offset, the other does not.",
    "?": "It is unknown whether a drive accepted its new zero. The next run will check.",
}


@pytest.mark.parametrize("joints", TEXTS)
def test_what_is_open_is_said_in_words(history: History, joints: str) -> None:
    history.writing(joints=joints)
    assert history.known().text == TEXTS[joints]


def test_rolled_back(history: History) -> None:
    history.writing()
    run = history.writing("rollback")
    known = history.known()
    assert (known.state, known.verified) == ("rolled back", False)
    assert known.text == "Rolled back: the drives hold the old zero offsets again."
    assert known.rollback_refused == f"{known.text} There is nothing to roll back."
    assert [(joint.state, joint.shift_deg) for joint in known.joints] == [
        ("rolled back", 0.0),
        ("rolled back", 0.0),
    ]
    assert [attempt.plan for attempt in known.runs] == ["apply", "rollback"]
    assert rolled_back_by(history.store, history.run) == run


def test_one_joint_taken_back_is_rolled_back_when_the_other_never_had_it(history: History) -> None:
    history.writing(joints="1")
    run = history.writing("rollback", joints="1")
    assert history.known().state == "rolled back"
    assert rolled_back_by(history.store, history.run) == run


def test_a_rollback_of_one_joint_alone_leaves_it_partly(history: History) -> None:
    history.writing()
    history.writing("rollback", joints="1")
    assert history.known().state == "partly"
    assert rolled_back_by(history.store, history.run) is None


def test_zeros_of_another_run_since(history: History) -> None:
    history.writing()
    second = history.calibrated()
    run = history.writing(of=second)
    known = history.known()
    assert (known.state, known.verified) == ("superseded", False)
    assert known.text == "The zeros of the drives have been changed since, for another run."
    changed = f"The zeros of the drives have been changed since, by run {run}."
    assert (known.apply_refused, known.rollback_refused) == (changed, changed)
    assert history.known(second).state == "applied"
    assert rolled_back_by(history.store, history.run) is None


def test_zeros_of_an_earlier_run_are_no_matter_of_a_later_calibration(history: History) -> None:
    history.writing()
    later = history.calibrated()
    assert history.known(later).state == "unwritten"
    assert refusal(check_apply, history, later) is None


def test_a_zero_of_another_run_that_was_not_taken_does_not_bar_an_apply(history: History) -> None:
    second = history.calibrated()
    history.writing(of=second, joints="xx")
    assert refusal(check_apply, history) is None


def test_who_has_nothing_to_apply(history: History) -> None:
    store = history.store
    applied = history.writing()
    failed = store.create(asked("R1", "rapid"), ROBOT)
    store.finish(failed, State.SUCCEEDED, result(verdict="fail", outcome="failed"))
    aborted = store.create(asked("R1", "rapid"), ROBOT)
    store.finish(aborted, State.ABORTED)
    diagnosed = store.create(asked("R1", "diagnostic"), ROBOT)
    store.finish(diagnosed, State.SUCCEEDED, RESULT)
    passed = f"Run {failed} has not passed; only the offsets of a pass are written."
    whys = {
        applied: f"Run {applied} is no calibration; it belongs to run {history.run}.",
        failed: passed,
        aborted: passed.replace(str(failed), str(aborted), 1),
        diagnosed: (
            f"Run {diagnosed} is of kind diagnosis, not a calibration; calibrate to have offsets to write."
        ),
    }
    for run, why in whys.items():
        assert (run, refusal(check_apply, history, run)) == (run, why)
        assert (run, refusal(check_roll_back, history, run)) == (run, why)
        assert application(store, store.summary(run)) is None


def test_a_run_of_a_kind_that_is_no_more_has_nothing_to_apply(history: History) -> None:
    run = history.store.create(replace(asked("R1", "rapid"), kind="palpate"), ROBOT)
    history.store.finish(run, State.SUCCEEDED, RESULT)
    assert application(history.store, history.store.summary(run)) is None
    why = f"Run {run} is of kind palpate, not a calibration; calibrate to have offsets to write."
    assert refusal(check_apply, history, run) == why


def test_a_changed_robot_file_bars_an_apply_but_not_the_way_back(history: History) -> None:
    history.store.save_robot(replace(ROBOT, L=(375.2, 375.0)))
    changed = "The file of robot R1 has changed since this run; calibrate again."
    assert refusal(check_apply, history) == changed
    assert history.known().apply_refused == changed
    history.writing()
    assert refusal(check_roll_back, history) is None
