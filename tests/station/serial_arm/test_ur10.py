"""Logs of a real arm: what the loop must reach on readings that it never learned from."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli import main
from station.diagnosis.learned.model_file import model_document
from station.diagnosis.learned.other_log import transfer
from station.diagnosis.report.joint_curves import curves
from station.diagnosis.report.traced_findings import TracedFindings
from station.diagnosis.tests_of_fit.cross_validation import without_a_quarter
from station.diagnosis.traced_loop import traced
from station.machines import AnyRobot, read_readings, read_robot
from station.records import Measured
from tests.station.simulated import DATA, needs_data

LOGS = DATA / "ur10"
ROBOT = Path(__file__).parents[3] / "docs/examples/ur10.toml"

# thousands of readings of six joints: half a minute on a quiet machine, several on a busy one
pytestmark = [needs_data, pytest.mark.long, pytest.mark.timeout(400)]


def robot() -> AnyRobot:
    return read_robot(ROBOT)


@cache
def found(log: str, measured: Measured) -> TracedFindings:
    readings = read_readings(robot(), LOGS / f"{log}.csv", measured)
    return TracedFindings(traced(robot(), *without_a_quarter(readings)))


@pytest.mark.parametrize(
    ("log", "measured", "most_mm", "base_mm"),
    [
        ("series_a", "position", 0.15, 0.47),
        ("series_b", "position", 0.165, 0.45),
        ("series_a", "range", 0.060, 0.16),
    ],
)
def test_held_out_error_after_the_loop(log: str, measured: Measured, most_mm: float, base_mm: float) -> None:
    stages = found(log, measured).stages
    nominal, base, last = (s.confirm_rms_mm for s in (stages[0], stages[1], stages[-1]))
    assert nominal is not None and base is not None and last is not None
    assert last <= most_mm
    # and the kinematic model alone is no worse than it should be
    assert base == pytest.approx(base_mm, rel=0.05)
    assert nominal > base


def test_the_cause_is_named_by_joint_and_cycles() -> None:
    result = found("series_a", "position")
    labels = [e.label for e in result.effects]
    assert {f"gear_cyclic curve of joint {i}" for i in (1, 2, 3)} <= set(labels)
    for effect in result.effects[:3]:
        sizes = {q.name: q for q in effect.parameters}
        assert sizes["per_rev"].value == pytest.approx(17.0, abs=0.6)
        assert sizes["amplitude_deg"].value > 10.0 * sizes["amplitude_deg"].sd


def test_both_logs_show_the_same_curve_where_both_have_been() -> None:
    """Joint 2 carries the whole arm: learned independently, months apart."""
    a, b = (
        next(c for c in curves(found(log, "position").diagnosis.last) if c.joint == 2)
        for log in ("series_a", "series_b")
    )
    grid = np.arange(-130.0, -70.0, 1.0)
    first, second = (np.interp(grid, c.angle_deg, c.value_deg) for c in (a, b))
    assert np.corrcoef(first, second)[0, 1] > 0.9


def test_learned_on_one_log_holds_unchanged_on_another() -> None:
    learned = found("series_a", "position").diagnosis
    part = model_document(learned, learned.last, 1.0, stage="last", confirmed=None)
    result = transfer(part, robot(), read_readings(robot(), LOGS / "series_b.csv"), "a")
    assert result.applied.rms_mm <= 0.21
    assert result.alone.rms_mm == pytest.approx(0.436, rel=0.05)
    assert result.inside > 400


def test_diagnose_and_transfer_from_the_terminal(tmp_path: Path) -> None:
    model, page = tmp_path / "b.json", tmp_path / "b.html"
    arguments = ["diagnose", str(LOGS / "series_b.csv"), "--robot", str(ROBOT), "--hold-out"]
    said = CliRunner().invoke(main, [*arguments, "--json", str(model), "--html", str(page)])
    assert said.exit_code == 1, said.output  # a rest stays: sent on to a person
    assert "gear ripple curve of joint 1" in " ".join(said.output.split())
    assert page.read_text().count("<svg") > 10
    moved = CliRunner().invoke(main, ["transfer", str(LOGS / "series_b.csv"), "--model", str(model)])
    assert moved.exit_code == 0, moved.output
    assert re.search(r"with effects, unchanged\s+│ 0\.0\d+", moved.output)
    targets = tmp_path / "targets.csv"
    targets.write_text("x_mm,y_mm\n0,-700\n")
    refused = CliRunner().invoke(main, ["solve", str(targets), "--model", str(model)])
    assert refused.exit_code == 2
    assert "serial arm" in refused.output


def test_identify_names_what_is_tied() -> None:
    said = CliRunner().invoke(main, ["identify", str(LOGS / "series_b.csv"), "--robot", str(ROBOT)])
    assert said.exit_code == 0, said.output
    assert "Not determined by the readings" in " ".join(said.output.split())
    assert "dtheta1 (looks like" in " ".join(said.output.split())
