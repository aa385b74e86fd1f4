"""The given measurement files: an effect is in most of them, and only answers.json says which."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np
import pytest

from station.diagnosis.closed_loop import diagnose
from station.diagnosis.report.document import Findings
from station.five_bar.robot_file import Robot
from station.records import read_measurements
from tests.station.simulated import DATA, needs_data

CASES = DATA / "undeclared"
NAMES = [f"case{k:02d}" for k in range(1, 21)]
OUTSIDE_HINTS = {"cable_drag": "approach x place", "stiction_patch": "place", "random_walk": "time"}
NOISE_MM = 1.2e-3

pytestmark = needs_data


@cache
def answers() -> dict[str, Any]:
    return dict(json.loads((CASES / "answers.json").read_text()))


@cache
def findings(name: str) -> Findings:
    learned = read_measurements(CASES / f"{name}.csv")
    fresh = read_measurements(CASES / f"{name}.fresh.csv")
    return Findings(diagnose(Robot.default(), learned, fresh))


@pytest.mark.parametrize("name", NAMES)
def test_right_verdict_and_cause(name: str) -> None:
    truth, found = answers()[name], findings(name)
    verdict, confirmed = found.diagnosis.verdict, found.diagnosis.confirmed
    if truth["effect"] == "none":
        assert (verdict, confirmed, found.effects, found.decision.passed) == ("adequate", True, (), True)
    elif truth["effect"] is None:
        assert not found.decision.passed
        assert not (verdict == "explained" and confirmed)
        (kind,) = truth["detail"]
        assert found.diagnosis.hints[0].depends_on == OUTSIDE_HINTS[kind]
    else:
        assert (verdict, confirmed) == ("explained", True)
        (effect,) = found.effects
        assert (truth["effect"], truth["joint"]) in [t.key for t in (effect.term, *effect.aliases)]
        assert len(effect.aliases) <= 2


def test_fresh_readings_are_predicted_within_the_pure_error() -> None:
    """Pooled, since twenty repeats of one file know their own scatter to 16 % only."""
    explained = [f for f in map(findings, NAMES) if f.diagnosis.verdict == "explained"]
    fresh = np.array([f.stages[-1].confirm_rms_mm for f in explained])
    pure = np.array([f.noise.sigma_mm for f in explained])
    assert len(explained) == 14
    assert np.sqrt(np.mean(fresh**2)) <= 1.15 * np.sqrt(np.mean(pure**2))


@pytest.mark.parametrize("name", NAMES)
def test_zero_offsets_agree_with_the_truth(name: str) -> None:
    truth = np.array(answers()[name]["zero_offsets_deg"])
    gain = answers()[name]["detail"].get("gain")
    if gain:
        # that machine's gain acts on the angle itself, ours from the drive's zero on, as drives count
        i = gain["joint"] - 1
        truth[i] += gain["ppm"] * 1e-6 * Robot.default().zero_at_deg[i]
    for q, true in zip(findings(name).parameters[:2], truth, strict=True):
        assert abs(q.value - true) < 4.0 * q.sd


@pytest.mark.parametrize("name", NAMES)
def test_every_stage_is_better_than_the_one_before_and_the_last_no_worse_than_noise(name: str) -> None:
    found = findings(name)
    fits = [s.fit_rms_mm for s in found.stages]
    assert fits == sorted(fits, reverse=True)
    for s in found.stages:
        assert s.holdout_rms_mm >= s.fit_rms_mm
    if found.decision.passed:
        assert found.stages[-1].holdout_rms_mm < 1.5 * NOISE_MM
