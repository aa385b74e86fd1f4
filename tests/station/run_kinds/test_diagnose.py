"""The closed loop on machines in virtual time: clean, with a named cause, with one outside the catalogue."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli import main
from station.errors import InputRefused, NotApplicable, NotFound
from station.five_bar.robot_file import Robot
from station.messages import dependence_name
from station.plans import make_plan
from station.plans.diagnostic_sequence import FRESH_PLACES, diagnostic_fresh_stops
from station.records import CalibrationResult, MeasurementSequence, PlanName, Reading, State
from station.run_kinds.zero_state import application, check_apply
from station.store.store import Store
from station.studies.simulation import SimulatedMachine
from tests.station.asking import asked, start_procedure
from tests.station.simulated import carried_out, read

ROBOT = Robot.default("R1")
TRUTH = np.concatenate([np.radians([0.8, -0.6]), np.zeros(8), [0.5, -0.3]])
BACKLASH = {"kind": "backlash", "joint": 1, "width_deg": 0.02}
DRAG = {"kind": "cable_drag", "joint": 1, "deg_at_end": 0.01}


def machine(*effects: dict[str, Any]) -> SimulatedMachine:
    return SimulatedMachine(ROBOT, TRUTH, "continuous", 6, effects)


def run(machine: SimulatedMachine, plan: PlanName = "diagnostic") -> tuple[list[Reading], CalibrationResult]:
    """A plan carried out in virtual time."""
    return carried_out(machine, start_procedure(plan, ROBOT))


def test_the_walk_reads_most_places_from_both_sides_and_ten_three_times() -> None:
    plan = make_plan("diagnostic", ROBOT)
    assert plan.stops == make_plan("diagnostic", ROBOT).stops
    assert len(plan.stops) == 120
    counted = [sum(s.position == p for s in plan.stops) for p in {s.position for s in plan.stops}]
    assert sorted(counted) == [2] * 35 + [5] * 10
    readings, _ = run(machine())
    sides = {(r.position, r.approach) for r in readings if r.sequence == 1}
    both = [p for p in {r.position for r in readings if r.sequence == 1} if sum(s[0] == p for s in sides) > 1]
    assert len(both) >= 40


def test_fresh_places_are_others_each_run_and_the_same_again_by_seed() -> None:
    first, second = (diagnostic_fresh_stops(ROBOT, np.zeros(2), seed) for seed in (1, 2))
    assert len(first) == FRESH_PLACES
    assert first == diagnostic_fresh_stops(ROBOT, np.zeros(2), 1)
    assert not {s.target_mm for s in first} & {s.target_mm for s in second}


def test_a_clean_machine_lacks_nothing() -> None:
    readings, result = run(machine())
    assert (result.verdict, result.outcome) == ("pass", "good")
    assert (result.method, result.findings) == ("diagnosis", ())
    assert result.reason.code == "adequate_confirmed"
    assert {"joint_angle", "drm_x", "second_mount"} <= {one.kind for one in result.advice}
    assert [r.sequence for r in readings] == [1] * 120 + [2] * 40
    for zero, truth in zip(result.zero_offsets, (0.8, -0.6), strict=True):
        assert abs(zero.value - truth) < 4 * zero.sd


def test_backlash_is_named_and_fresh_readings_confirm_it() -> None:
    _, result = run(machine(BACKLASH))
    # a defect was found: the robot may not be used as it is
    assert (result.verdict, result.outcome) == ("fail", "repair")
    assert result.reason.code == "explained_confirmed"
    assert result.reason.text.startswith("Backlash of joint 1 explained 9")
    (finding,) = result.findings
    (width,) = finding.parameters
    assert abs(width.value - 0.02) < 4 * width.sd
    before, after = result.before, result.after
    assert before is not None and before.fresh_reading_rms_mm is not None
    assert after is not None and after.fresh_reading_rms_mm is not None
    assert before.fresh_reading_rms_mm > 5 * after.fresh_reading_rms_mm
    assert result.diagnosis is not None
    assert (result.diagnosis.verdict, result.diagnosis.confirmed) == ("explained", True)
    assert len(result.residuals) == 120


def test_what_the_catalogue_does_not_hold_fails_and_says_what_it_depends_on() -> None:
    _, result = run(machine(DRAG))
    assert result.verdict == "fail"
    assert result.diagnosis is not None
    assert result.diagnosis.hints
    depends_on = result.diagnosis.hints[0].depends_on
    assert f"it depends on {dependence_name(depends_on, 'en')}" in result.reason.text


@pytest.mark.parametrize("plan", ["paper", "rapid", "full"])
def test_lack_of_fit_is_judged_at_once_after_any_calibration(tmp_path: Path, plan: PlanName) -> None:
    assert run(machine(), plan)[1].lack_of_fit is None
    _, result = run(machine({**BACKLASH, "width_deg": 0.05}), plan)
    assert result.verdict == "fail"
    assert result.lack_of_fit == result.reason.text != "" and result.lack_of_fit_reason == result.reason
    store = Store(tmp_path / "station.db")
    kept = store.create(asked("R1", plan), ROBOT)
    assert store.calibration(kept).lack_of_fit is None
    store.finish(kept, State.SUCCEEDED, result)
    found = store.calibration(kept)
    assert found.lack_of_fit_reason is not None
    assert found.lack_of_fit == found.lack_of_fit_reason.text == result.reason.text
    store.close()


@pytest.mark.parametrize("plan", ["rapid", "full"])
def test_an_effect_too_large_for_any_fit_is_a_lack_of_fit_too(tmp_path: Path, plan: PlanName) -> None:
    """Nothing can be said of the zero offsets then, but what to do next."""
    readings, result = run(machine({"kind": "link_length", "joint": 1, "link": "L", "mm": 6.0}), plan)
    assert (result.verdict, result.zero_offsets, result.lasting) == ("fail", (), None)
    assert (result.lack_of_fit, result.lack_of_fit_reason) == (result.reason.text, result.reason)
    assert "run the diagnosis" in result.reason.text
    store = Store(tmp_path / "station.db")
    kept = store.create(asked("R1", plan), ROBOT)
    store.add_readings(kept, readings)
    assert store.finish(kept, State.SUCCEEDED, result) is State.SUCCEEDED
    found = store.calibration(kept)
    assert (found.verdict, found.zero_offsets, found.lack_of_fit) == ("fail", (), result.reason.text)
    with pytest.raises(NotApplicable):
        check_apply(store, asked("R1", "apply", of=kept))
    store.close()


def test_readings_of_another_robot_are_refused() -> None:
    procedure = start_procedure("diagnostic", ROBOT)
    sequence = next(procedure)
    assert isinstance(sequence, MeasurementSequence)
    readings = read(machine(), sequence)
    with pytest.raises(InputRefused, match="Not enough data to judge"):
        procedure.send(readings[:20])


def test_the_document_is_kept_with_every_digit_and_no_list_carries_it(tmp_path: Path) -> None:
    _, result = run(machine(BACKLASH))
    store = Store(tmp_path / "station.db")
    kept = store.create(asked("R1", "diagnostic"), ROBOT)
    with pytest.raises(NotFound, match="has no diagnosis"):
        store.diagnosis(kept)
    assert store.finish(kept, State.SUCCEEDED, result) is State.SUCCEEDED
    assert result.diagnosis is not None
    assert store.diagnosis(kept).model_dump_json() == result.diagnosis.model_dump_json()
    assert not hasattr(store.calibration(kept), "diagnosis")
    assert not hasattr(store.calibrations().items[0], "findings")
    assert store.calibration(kept).findings[0].effect == "backlash"
    with pytest.raises(NotFound, match="There is no calibration 99"):
        store.diagnosis(99)
    with pytest.raises(NotApplicable, match="of kind diagnosis"):
        check_apply(store, asked("R1", "apply", of=kept))
    assert application(store, store.calibration(kept)) is None
    store.close()


def test_the_plan_can_be_asked_for_at_the_terminal(tmp_path: Path) -> None:
    outcome = CliRunner().invoke(
        main, ["plan", "--plan", "diagnostic", "--json", str(tmp_path / "plan.json")]
    )
    assert outcome.exit_code == 0, outcome.output
    assert len(json.loads((tmp_path / "plan.json").read_text())["stops"]) == 120
