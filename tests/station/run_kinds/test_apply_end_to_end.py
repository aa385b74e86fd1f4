"""Apply and roll back over real wires: the emulated rig, its drives and its faults."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from station.cli import main
from station.records import Calibration, PlanName
from station.run_kinds.zero_state import application
from station.service.runtime import Runtime
from station.settings import EmulatedSettings, Settings
from tests.station.asking import asked

FAST = Settings(emulated=EmulatedSettings(speed=1000.0))
OFFSETS = (1.2, -0.8)
RIG = f"[machine]\nzero_offsets_deg = {list(OFFSETS)}\ndrm_mm = [1.0, 0.5]\n"
LIMIT_S = 60.0


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    file = tmp_path / "rig.toml"
    file.write_text(RIG)
    return file


def ended(runtime: Runtime, run: int) -> Calibration:
    assert runtime.orchestrator.wait(run, LIMIT_S).ended
    return runtime.store.calibration(run)


def calibrate(runtime: Runtime, plan: PlanName) -> Calibration:
    return ended(runtime, runtime.orchestrator.submit(asked("R1", plan)).id)


def apply(runtime: Runtime, calibration: int) -> Calibration:
    return ended(runtime, runtime.orchestrator.follow("apply", calibration, "ada").id)


def roll_back(runtime: Runtime, calibration: int) -> Calibration:
    return ended(runtime, runtime.orchestrator.follow("rollback", calibration, "ada").id)


def state(runtime: Runtime, calibration: int) -> str:
    found = application(runtime.store, runtime.store.calibration(calibration))
    assert found is not None
    return str(found.state)


def assert_offsets(run: Calibration, expected: tuple[float, float]) -> None:
    """Within four standard deviations, and what the servo may stand beside a zero."""
    for zero, offset in zip(run.zero_offsets, expected, strict=True):
        assert zero.value_deg == pytest.approx(offset, abs=4 * (zero.sd_deg or 0.0) + 0.02)


@pytest.mark.parametrize("plan", ["paper", "full"])
def test_after_an_apply_hardly_an_offset_is_found_and_after_a_rollback_the_old_ones(
    tmp_path: Path, rig: Path, plan: PlanName
) -> None:
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        first = calibrate(runtime, plan)
        assert_offsets(first, OFFSETS)
        applied = apply(runtime, first.id)
        assert (applied.verdict, state(runtime, first.id)) == ("pass", "applied"), applied.reason
    # the drives keep their zeros while the power is off
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        again = calibrate(runtime, "rapid")
        assert_offsets(again, (0.0, 0.0))
        if plan == "full":
            assert again.memory is not None and again.memory.used
            assert again.memory.from_calibration == first.id
        back = roll_back(runtime, first.id)
        assert (back.verdict, state(runtime, first.id)) == ("pass", "rolled back"), back.reason
        assert_offsets(calibrate(runtime, "rapid"), OFFSETS)


def test_a_drive_that_keeps_refusing_leaves_everything_as_it_was(tmp_path: Path, rig: Path) -> None:
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        first = calibrate(runtime, "rapid")
    rig.write_text(RIG + '[[fault]]\nkind = "drive_exception"\nafter = 60\ntimes = 100000\n')
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        outcome = apply(runtime, first.id)
        assert (outcome.state, outcome.verdict) == ("failed", None)
        assert state(runtime, first.id) == "unwritten"


def test_a_coupling_that_slips_during_the_apply_rolls_it_back(tmp_path: Path, rig: Path) -> None:
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        first = calibrate(runtime, "rapid")
    slip = '[[effect]]\nkind = "count_slip"\njoint = 2\nstep_deg = 0.2\nfrom_stop = 9\n'
    rig.write_text(RIG + slip)
    with Runtime.open(FAST, tmp_path, rig) as runtime:
        outcome = apply(runtime, first.id)
        assert (outcome.state, outcome.verdict) == ("succeeded", "fail")
        assert "Rolled back" in (outcome.reason or "")
        assert state(runtime, first.id) == "rolled back"


def test_the_terminal_applies_and_rolls_back(tmp_path: Path, rig: Path) -> None:
    def station(*arguments: str) -> Result:
        return CliRunner().invoke(main, ["--home", str(tmp_path), *arguments])

    machine = ("--emulate", str(rig), "--speed", "1000")
    assert station("calibrate", "--plan", "rapid", "--serial", "R1", *machine).exit_code == 0
    refused = station("rollback", "1", *machine)
    assert (refused.exit_code, len(refused.output.splitlines())) == (2, 1)
    assert "nothing to roll back" in refused.output
    applied = station("apply", "1", *machine)
    assert applied.exit_code == 0
    assert re.search(r"Run 2 PASS: Verified: fresh readings agree within", applied.output)
    back = station("rollback", "1", *machine)
    assert (back.exit_code, "The old zero offsets are in the drives" in back.output) == (0, True)
    assert station("apply", "9", *machine).exit_code == 2
