"""The given measurement files: most have an effect or a mistake, and only answers.json says which."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np
import pytest

from station.diagnosis.closed_loop import diagnose
from station.diagnosis.mistakes import MistakeRefused
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.weighed_loop import WeighedDiagnosis
from station.five_bar.robot_file import Robot
from station.machines import read_readings
from tests.station.simulated import DATA, needs_data

UNDECLARED, HARD = DATA / "undeclared", DATA / "hard"
NAMES = [f"case{k:02d}" for k in range(1, 21)]
OUTSIDE_HINTS = {"cable_drag": "approach x place", "stiction_patch": "place", "random_walk": "time"}
NOISE_MM = 1.2e-3

CAUSES: dict[str, set[tuple[str, int | None]]] = {
    "01_distal_link_5mm_long": {("link_length", 1)},
    "02_wrong_ratio_both_joints_1pct": {("transmission_gain", 1), ("transmission_gain", 2)},
    "03_both_arms_sag_0.05deg": {("compliance", 1), ("compliance", 2)},
    "04_both_arms_sag_0.1deg": {("compliance", 1), ("compliance", 2)},
    "05_both_L_1mm_long": {("link_length", 1), ("link_length", 2)},
    "07_readout_steps_10um": {("reading_step", None)},
    "22_two_mounts_l1_5mm": {("link_length", 1)},
    "23_two_mounts_l1_2mm": {("link_length", 1)},
}
ADEQUATE = ("17_glitches_7_of_120", "20_every_row_same_position")
"""Nothing but a wrong label, or readings that are left out."""
GLITCHES = 5
"""Of the seven, so many at least are far off."""

pytestmark = needs_data


@cache
def answers(folder: str) -> dict[str, Any]:
    return dict(json.loads((DATA / folder / "answers.json").read_text()))


def hard() -> list[str]:
    return sorted(answers("hard")) if HARD.exists() else []


@cache
def findings(folder: str, name: str) -> WeighedFindings:
    """:raises MistakeRefused: a file that cannot be diagnosed as it is."""
    robot_file = answers(folder)[name].get("robot_file")
    robot = Robot.from_toml(DATA / folder / robot_file) if robot_file else Robot.default()
    learned, fresh = (
        read_readings(robot, DATA / folder / f"{name}{kind}.csv", in_order=False) for kind in ("", ".fresh")
    )
    found = diagnose(robot, learned, fresh)
    assert isinstance(found, WeighedDiagnosis)
    return WeighedFindings(found)


@pytest.mark.parametrize("name", NAMES)
def test_right_verdict_and_cause(name: str) -> None:
    truth, found = answers("undeclared")[name], findings("undeclared", name)
    verdict, confirmed = found.decision.verdict, found.decision.confirmed
    assert found.mistake is None
    if truth["effect"] == "none":
        assert (verdict, confirmed, found.effects, found.decision.outcome) == ("adequate", True, (), "good")
    elif truth["effect"] is None:
        assert not found.decision.passed
        assert not (verdict == "explained" and confirmed)
        (kind,) = truth["detail"]
        assert found.hints[0].depends_on == OUTSIDE_HINTS[kind]
    else:
        # a small smooth effect may be as probable as an unnamed one: then the truth comes first in the set
        assert (verdict, confirmed) in [("explained", True), ("ambiguous", False)]
        first = found.effects[0]
        keys = {(n.effect, n.joint) for e in found.effects for n in (e.name, *e.aliases)}
        assert (truth["effect"], truth["joint"]) in keys
        assert first.probability is not None and first.probability > (0.95 if confirmed else 0.5)
        if verdict == "ambiguous":
            assert found.experiments and found.experiments[0].decides > 0.5
            assert found.decision.outcome == "ambiguous"
        else:
            assert found.decision.outcome == "repair"


def test_nearly_all_are_explained() -> None:
    explained = [n for n in NAMES if findings("undeclared", n).decision.verdict == "explained"]
    assert len(explained) >= 13


def test_fresh_readings_are_predicted_within_the_pure_error() -> None:
    """Pooled, since twenty repeats of one file know their own scatter to 16 % only."""
    every = [findings("undeclared", name) for name in NAMES]
    explained = [f for f in every if f.decision.verdict == "explained"]
    fresh = np.array([f.stages[-1].confirm_rms_mm for f in explained])
    pure = np.array([f.noise.sigma_mm for f in explained])
    assert np.sqrt(np.mean(fresh**2)) <= 1.15 * np.sqrt(np.mean(pure**2))


@pytest.mark.parametrize("name", NAMES)
def test_zero_offsets_agree_with_the_truth(name: str) -> None:
    truth = np.array(answers("undeclared")[name]["zero_offsets_deg"])
    gain = answers("undeclared")[name]["detail"].get("gain")
    if gain:
        # that machine's gain acts on the angle itself, ours from the drive's zero on, as drives count
        i = gain["joint"] - 1
        truth[i] += gain["ppm"] * 1e-6 * Robot.default().zero_at_deg[i]
    for q, true in zip(findings("undeclared", name).parameters[:2], truth, strict=True):
        assert abs(q.value - true) < 4.0 * q.sd


@pytest.mark.parametrize("name", NAMES)
def test_every_stage_is_better_than_the_one_before_and_the_last_no_worse_than_noise(name: str) -> None:
    found = findings("undeclared", name)
    fits = [s.fit_rms_mm for s in found.stages[1:]]
    assert fits == sorted(fits, reverse=True)
    for s in found.stages:
        assert s.holdout_rms_mm >= s.fit_rms_mm
    # a reading whose direction is in doubt cannot be predicted without itself
    hysteresis = [e for e in found.effects if e.name.effect == "scale_hysteresis"]
    if found.decision.passed and not hysteresis:
        assert found.stages[-1].holdout_rms_mm < 1.5 * NOISE_MM


@pytest.mark.parametrize("name", hard())
def test_hard_case_as_its_answer_says(name: str) -> None:
    answer = answers("hard")[name]
    try:
        found = findings("hard", name)
    except MistakeRefused as refusal:
        assert refusal.mistake.kind == answer["mistake_kind"]
        return
    decision = found.decision
    if answer["mistake_kind"] is not None:
        assert found.mistake is not None and found.mistake.kind == answer["mistake_kind"]
        # few glitches are left out by name; with any other mistake nothing is confirmed
        few = answer["mistake_kind"] == "glitches"
        assert (decision.confirmed, decision.outcome == "good") == (few, few)
        assert (decision.verdict == "adequate") == (name in ADEQUATE)
        return
    assert found.mistake is None
    if name.startswith("06"):
        assert decision.outcome == "unexplained"
        assert not any(e.name.effect == "gear_cyclic" for e in found.effects)
    elif name.startswith("16"):
        growth = {e.name.part: e for e in found.effects}
        assert {e.name.effect for e in found.effects} == {"thermal_growth"}
        (expansion,) = growth["scale"].parameters
        assert expansion.value == pytest.approx(9.0, abs=4.0 * expansion.sd)
    else:
        assert {(e.name.effect, e.name.joint) for e in found.effects} == CAUSES[name]
        assert (decision.verdict, decision.confirmed, decision.outcome) == ("explained", True, "repair")
    for q, true in zip(found.parameters[:2], answer["true_zero_offsets_deg"], strict=True):
        assert abs(q.value - true) < 3.0 * q.sd


def test_glitches_are_named_by_row() -> None:
    found = findings("hard", "17_glitches_7_of_120")
    assert found.mistake is not None
    assert len(found.mistake.rows) >= GLITCHES
    assert {o.reading for o in found.outliers} >= set(found.mistake.rows)
