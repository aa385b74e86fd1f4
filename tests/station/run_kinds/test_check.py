"""Plan `check`: what it finds with 99 %, how seldom it errs, what it compares with."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from station.errors import NotApplicable
from station.five_bar import FiveBar, Robot
from station.identification import Identification, identify
from station.plans import make_plan
from station.records import CalibrationResult, CheckFound, State
from station.run_kinds import RUN_KINDS
from station.run_kinds.check import Calibrated, check_run, compared_with
from station.run_kinds.lock import calibration_holds, check_not_locked
from station.store.store import Store
from station.studies.drawn import Drawn, drawn, robot_of
from station.studies.walked import walk
from tests.station.asking import asked
from tests.station.fakes import result_of

ROBOT = robot_of(0.03)
TOMORROW = datetime(2030, 1, 1, tzinfo=UTC)


@cache
def calibrated(seed: int) -> tuple[Drawn, Identification[FiveBar]]:
    machine, _ = drawn(ROBOT, seed)
    stops = make_plan("full", ROBOT).stops
    return machine, identify(ROBOT, machine.machine().run(stops, 5))


def checked(seed: int, shift_deg: tuple[float, float] = (0.0, 0.0)) -> CalibrationResult:
    machine, fit = calibrated(seed)
    truth = machine.truth.copy()
    truth[:2] += np.radians(shift_deg)
    return walk(check_run(fit, 0.0, TOMORROW), Drawn(ROBOT, truth, seed).machine(1)).result


def test_machines_that_did_not_change_pass() -> None:
    results = [checked(seed) for seed in range(16)]
    assert sum(result.verdict == "fail" for result in results) <= 1
    found = results[0].check
    assert found is not None
    assert found.smallest_shift_deg == max(found.smallest_by_joint_deg)
    assert found.blind_shift_deg >= 0.7 * min(found.smallest_by_joint_deg)
    assert found.valid_until == TOMORROW
    judged = [one for result in results for one in result.residuals]
    assert all(0.001 < (one.limit_mm or 0.0) < 1.0 for one in judged)
    assert sum(abs(one.residual_mm or 0.0) > (one.limit_mm or 0.0) for one in judged) <= 1


@pytest.mark.parametrize("joint", [0, 1])
def test_the_smallest_shift_is_found(joint: int) -> None:
    stated = checked(0).check
    assert stated is not None
    results = []
    for seed in range(12):
        shift = [0.0, 0.0]
        shift[joint] = stated.smallest_by_joint_deg[joint] * (1 if seed % 2 else -1)
        results.append(checked(seed, (shift[0], shift[1])))
    assert sum(result.verdict == "fail" for result in results) >= 11
    failed = results[-1]
    assert (failed.outcome, failed.reason.code) == ("repair", "zero_shifted")
    assert failed.check is not None
    assert failed.check.valid_until is None
    assert failed.check.shift_deg[joint] > 0.5 * stated.smallest_by_joint_deg[joint]


def test_a_shift_that_a_newer_calibration_has_found_is_to_be_applied() -> None:
    """The joints have slipped, the newer run has found it, the drives hold the zeros of the older one."""
    machine, fit = calibrated(3)
    truth = machine.truth.copy()
    truth[:2] += np.radians([0.9, -0.2])
    slipped = Drawn(ROBOT, truth, 3)
    newer = identify(ROBOT, slipped.machine(2).run(make_plan("full", ROBOT).stops, 5))
    result = walk(check_run(fit, 0.0, TOMORROW, Calibrated(8, newer, 0.0)), slipped.machine(1)).result
    assert (result.verdict, result.reason.code) == ("fail", "shift_known")
    assert result.check is not None
    assert result.check.known_by == 8
    assert result.check.shift_deg == pytest.approx((0.9, -0.2), abs=0.05)
    other = walk(check_run(fit, 0.0, TOMORROW, Calibrated(8, fit, 0.0)), slipped.machine(1)).result
    assert (other.reason.code, other.check and other.check.known_by) == ("zero_shifted", None)


def test_the_calibration_that_knows_the_shift_may_be_applied_and_clears_the_lock(store: Store) -> None:
    def run(kind: str, verdict: str, check: CheckFound | None = None, of: int | None = None) -> int:
        request = asked("R1", "full" if kind == "calibrate" else kind)
        number = store.create(replace(request, kind=kind, of=of), Robot.default("R1"))
        result = result_of([], verdict).model_copy(update={"check": check})
        store.finish(number, State.SUCCEEDED, result)
        return number

    older, newer = run("calibrate", "pass"), run("calibrate", "pass")
    known = checked(0).check
    assert known is not None
    run("check", "fail", known.model_copy(update={"known_by": newer}))
    check_not_locked(store, newer)
    with pytest.raises(NotApplicable, match="Locked"):
        check_not_locked(store, older)
    assert calibration_holds(store, "R1").locked
    run("apply", "pass", of=older)
    assert calibration_holds(store, "R1").locked
    run("apply", "pass", of=newer)
    assert not calibration_holds(store, "R1").locked
    store.close()


def test_what_no_shift_explains_is_told_apart() -> None:
    machine, fit = calibrated(1)
    truth = machine.truth.copy()
    truth[10] += 1.0
    result = walk(check_run(fit, 0.0, TOMORROW), Drawn(ROBOT, truth, 1).machine(1)).result
    assert result.verdict == "fail"


def test_an_old_calibration_finds_less() -> None:
    machine, fit = calibrated(0)
    new, old = (
        walk(check_run(fit, days, TOMORROW), machine.machine(1)).result.check for days in (0.0, 3650.0)
    )
    assert new is not None
    assert old is not None
    assert old.smallest_shift_deg > 1.2 * new.smallest_shift_deg


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "station.db")


def test_it_needs_a_calibration_and_takes_the_last_pass(store: Store) -> None:
    start = RUN_KINDS["check"].check
    with pytest.raises(NotApplicable, match="calibrate first"):
        start(store, asked("R1", "check"))
    runs = []
    for verdict in ("pass", "pass", "fail"):
        run = store.create(asked("R1", "full"), Robot.default("R1"))
        store.finish(run, State.SUCCEEDED, result_of([], verdict))
        runs.append(run)
    start(store, asked("R1", "check"))
    found = compared_with(store, "R1")
    assert found is not None
    assert found.id == runs[1]
    store.close()
