"""What a run leaves to the robot's next one: kept with a pass, used, aged, dropped, forgotten."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from station.cli import main
from station.errors import NotFound
from station.five_bar.robot_file import Robot
from station.records import (
    Accuracy,
    Actor,
    Calibration,
    CalibrationResult,
    LastingParameters,
    PlanName,
    Quantity,
    Remembered,
    State,
)
from station.service.runtime import Runtime
from station.settings import EmulatedSettings, Settings
from station.store.store import Store
from tests.station.asking import asked
from tests.station.fakes import result_of

FAST = Settings(emulated=EmulatedSettings(speed=1000.0))
LASTING = LastingParameters(names=("rMx", "rMy"), mean=(1.0, 0.5), covariance=((0.0004, 0.0), (0.0, 0.0001)))
LIMIT_S = 60.0


def finish(
    store: Store, *, serial: str = "R1", robot: Robot | None = None, verdict: str = "pass", **changes: Any
) -> int:
    run = store.create(asked(serial, "full"), robot or Robot.default(serial))
    made: CalibrationResult = result_of([], verdict).model_copy(update={"lasting": LASTING, **changes})
    store.finish(run, State.SUCCEEDED, made)
    return run


def test_the_newest_pass_is_what_is_remembered(store: Store) -> None:
    assert store.memory("R1") is None
    finish(store)
    second = finish(store)
    finish(store, verdict="fail")
    finish(store, serial="R2")
    known = store.memory("R1")
    assert known is not None
    assert (known.calibration_id, known.memory) == (second, LASTING)
    assert known.summary().parameters[0] == Quantity("rMx", 1.0, 0.02, "mm")


def test_a_result_that_is_no_pass_leaves_nothing(store: Store) -> None:
    run = finish(store, after=Accuracy(reading_rms_mm=float("nan")))
    assert store.memory("R1") is None
    with pytest.raises(NotFound, match="left no memory"):
        store.memory_left_by(run)


def test_forgotten_is_not_used_and_stays_on_record(store: Store) -> None:
    run = finish(store)
    for _ in range(2):
        store.forget("R1", Actor(name="ada", via="open"))
    assert store.memory("R1") is None
    assert store.memory_left_by(run).memory == LASTING
    again = finish(store)
    known = store.memory("R1")
    assert known is not None
    assert known.calibration_id == again
    with pytest.raises(NotFound):
        store.forget("R9", Actor(name="ada", via="open"))


def test_a_changed_robot_file_starts_without_memory(store: Store) -> None:
    finish(store)
    store.save_robot(replace(Robot.default("R1"), L=(375.1, 375.0)))
    assert store.memory("R1") is None


def test_age_is_never_negative() -> None:
    tomorrow = datetime.now(UTC) + timedelta(days=1)
    assert Remembered(1, tomorrow, LASTING).age_days == 0.0
    assert Remembered(1, tomorrow - timedelta(days=11), LASTING).age_days == pytest.approx(10.0, abs=0.01)


def calibrate(runtime: Runtime, plan: PlanName) -> Calibration:
    run = runtime.orchestrator.submit(asked("R1", plan)).id
    assert runtime.orchestrator.wait(run, LIMIT_S) is State.SUCCEEDED
    return runtime.store.calibration(run)


def test_a_rapid_run_after_a_full_one_is_surer_until_it_is_told_to_forget(tmp_path: Path) -> None:
    with Runtime.open(FAST, tmp_path) as runtime:
        alone = calibrate(runtime, "rapid")
        runtime.store.forget("R1", Actor(name="ada", via="open"))
        full = calibrate(runtime, "full")
        rapid = calibrate(runtime, "rapid")
        paper = calibrate(runtime, "paper")
        runtime.store.forget("R1", Actor(name="ada", via="open"))
        without = calibrate(runtime, "rapid")
    assert [run.verdict for run in (alone, full, rapid, paper, without)] == ["pass"] * 5
    assert (full.memory, paper.memory, without.memory) == (None, None, None)
    assert rapid.memory is not None and rapid.memory.age_days is not None
    assert rapid.memory.used
    assert rapid.memory.from_calibration == full.id
    assert 0.0 <= rapid.memory.age_days < 1.0
    for zero, before in zip(rapid.zero_offsets, alone.zero_offsets, strict=True):
        assert zero.sd_deg is not None and before.sd_deg is not None
        assert zero.sd_deg < 0.75 * before.sd_deg


def test_a_mechanism_mounted_anew_drops_the_memory_and_says_so(tmp_path: Path) -> None:
    first, second = tmp_path / "first.toml", tmp_path / "second.toml"
    first.write_text("[machine]\ndrm_mm = [1.0, 0.5]\n")
    second.write_text("[machine]\ndrm_mm = [1.4, -0.3]\n")
    with Runtime.open(FAST, tmp_path, first) as runtime:
        calibrate(runtime, "full")
    with Runtime.open(FAST, tmp_path, second) as runtime:
        memory = calibrate(runtime, "full").memory
    assert memory is not None
    assert not memory.used
    assert "remounted" in memory.text


def test_the_terminal_shows_and_clears_what_is_remembered(tmp_path: Path, store: Store) -> None:
    run = finish(store)

    def memory(*arguments: str) -> str:
        result = CliRunner().invoke(main, ["--home", str(tmp_path), "memory", *arguments])
        assert result.exit_code == 0
        return result.output

    assert f"from run {run}" in memory("R1")
    assert "rMx  +1.0000 mm, sd 0.0200" in memory("R1")
    assert memory("R1", "--clear") == "Nothing is remembered of robot R1.\n"
    assert CliRunner().invoke(main, ["--home", str(tmp_path), "memory", "R9"]).exit_code == 2
