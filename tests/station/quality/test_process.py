"""Run rules, charts and capability: textbook run lengths and published examples."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.special import erf

from station.cli import main
from station.five_bar import Robot
from station.quality.capability import Index as Capability
from station.quality.capability import Limits, cpk, ppk, with_confidence
from station.quality.control_chart import _RULES, RULE_TEXTS, Rule, ewma, ewma_limits, run_rules
from station.quality.process import quality, trend
from station.records import CalibrationRequest, EffectPoint, Index, Real, State, TrendPoint
from station.store import Store
from tests.station.fakes import result_of

LONGEST_PATTERN = 15
QUIET = [0.5, -0.5, 0.6, 0.4, -0.6, -0.4, 0.3, 0.5, -0.2, -0.6, 0.2, 0.6]
PATTERNS: dict[Rule, tuple[list[float], int]] = {
    "nelson_1": ([3.1], 0),
    "nelson_2": ([0.2, 0.3, 0.1, 0.4, 0.2, 0.3, 0.1, 0.5, 0.2], 8),
    "nelson_3": ([-0.9, -0.5, -0.1, 0.2, 0.6, 0.9], 5),
    "nelson_4": ([0.2, -0.2] * 7, 13),
    "nelson_5": ([2.2, 0.1, 2.3], 2),
    "nelson_6": ([1.2, 1.3, 0.1, 1.1, 1.4], 4),
    "nelson_7": ([0.1, -0.2, -0.3, 0.4, 0.3] * 3, 14),
    "nelson_8": ([1.2, -1.3, -1.4, 1.1, -1.2, 1.5, 1.3, -1.1], 7),
}


def mean_run_length(values: Real, rules: Sequence[Rule]) -> float:
    """Mean number of values up to an alarm, begun anew after each one.

    A pattern that began before counts no more: what would complete one too soon is looked at again.
    """

    def alarms(part: Real) -> Index:
        return np.flatnonzero(np.logical_or.reduce([_RULES[rule](part) for rule in rules]))

    everywhere = alarms(values)
    begin, k, lengths = 0, 0, []
    while k < len(everywhere):
        at = int(everywhere[k])
        k += 1
        if at >= begin + LONGEST_PATTERN or at - begin in alarms(values[begin : at + 1]):
            lengths.append(at + 1 - begin)
            begin = at + 1
    return float(np.mean(lengths))


@pytest.mark.parametrize("rule", PATTERNS)
def test_each_rule_by_hand(rule: Rule) -> None:
    values, at = PATTERNS[rule]
    broken = run_rules(np.array(values), 0.0, 1.0)[rule]
    assert list(np.flatnonzero(broken)) == [at]
    # mirrored it is the same rule, one value short it is none
    assert list(np.flatnonzero(run_rules(-np.array(values), 0.0, 1.0)[rule])) == [at]
    assert not run_rules(np.array(values[:-1]), 0.0, 1.0)[rule].any()
    assert not run_rules(np.array(QUIET), 0.0, 1.0)[rule].any()
    assert rule in RULE_TEXTS


INSIDE = float(erf(1.0 / np.sqrt(2.0)))
"""Probability of a value within one standard deviation."""


@pytest.mark.parametrize(
    ("rules", "textbook"),
    [
        (("nelson_1",), 370.4),
        # Champ and Woodall, Technometrics 29 (1987), with two of three, and with four of five
        (("nelson_1", "nelson_5"), 225.44),
        (("nelson_1", "nelson_6"), 166.05),
        # exact: nine tosses of a coin alike, and fifteen in a row of a probability (Feller 1968, XIII.7)
        (("nelson_2",), 2.0**9 - 1.0),
        (("nelson_7",), (1.0 - INSIDE**15) / ((1.0 - INSIDE) * INSIDE**15)),
    ],
)
def test_run_length_without_a_change(rules: tuple[Rule, ...], textbook: float) -> None:
    values = np.random.default_rng(11).normal(size=3_000_000)
    assert mean_run_length(values, rules) == pytest.approx(textbook, rel=0.05)


@pytest.mark.parametrize(("shift", "textbook"), [(1.0, 43.89), (2.0, 6.30)])
def test_run_length_after_a_shift(shift: float, textbook: float) -> None:
    """Of individuals with limits at three standard deviations (Montgomery, chapter 9)."""
    values = np.random.default_rng(13).normal(shift, 1.0, size=100_000)
    assert mean_run_length(values, ("nelson_1",)) == pytest.approx(textbook, rel=0.05)


def test_run_length_of_the_ewma() -> None:
    """Lucas and Saccucci 1990: 500 without a change."""
    rng = np.random.default_rng(12)
    low, high = ewma_limits(5000, 0.0, 1.0)
    outside = [(lambda e: (e < low) | (e > high))(ewma(rng.normal(size=5000), 0.0)) for _ in range(4000)]
    lengths = [int(np.argmax(o)) + 1 if o.any() else 5000 for o in outside]
    assert np.mean(lengths) == pytest.approx(500.0, rel=0.05)


def test_confidence_limits_by_hand() -> None:
    """Montgomery, chapter 8, equation of the approximate interval: 20 values, index 1.33."""
    found = with_confidence(1.33, 20, 19)
    assert (round(found.low, 2), round(found.high, 2)) == (0.88, 1.78)


@pytest.mark.parametrize("of", [cpk, ppk])
def test_confidence_limits_hold_the_truth(of: Callable[[Real, Limits], Capability | None]) -> None:
    limits = Limits(-10.0, 4.0)
    rng = np.random.default_rng(5)
    found = [of(rng.normal(size=30), limits) for _ in range(1500)]
    held = np.mean([index is not None and index.low <= 4.0 / 3.0 <= index.high for index in found])
    assert 0.93 <= held <= 0.97


def point(run: int, first: float | None, error: float | None = 0.2, **changes: Any) -> TrendPoint:
    known = {"kind": "calibrate", "plan": "rapid", "state": State.SUCCEEDED, "outcome": "good"}
    measured = {"dtheta1_deg": first, "dtheta2_deg": 0.1, "position_error_mm": error}
    return TrendPoint.model_validate(
        {"id": run, "uid": f"u{run}", "robot_serial": "R1", **measured, **known, **changes}
    )


def test_figures_and_pareto_of_runs() -> None:
    rng = np.random.default_rng(3)
    values = rng.normal(0.1, 0.02, 40)
    values[25] = 0.4
    points = [point(k + 1, float(v)) for k, v in enumerate(values)]
    points.append(point(41, None, None, state=State.FAILED, outcome="failed", reason_code="device"))
    found = quality(points, zero_offset_deg=0.5, position_error_mm=0.5)
    assert found.runs == 41 and found.dtheta1.n == 40
    assert found.dtheta1.cpk is not None and found.dtheta1.ppk is not None
    assert found.dtheta1.ppk < found.dtheta1.cpk
    assert ("nelson_1", 26) in {(rule.name, rule.at) for rule in found.dtheta1.rules}
    # a quantity that never changes has no index, and none is invented
    assert found.position_error.n == 40 and found.position_error.cpk is None
    assert [(row.outcome, row.count) for row in found.pareto] == [("good", 40), ("failed", 1)]


def test_no_runs_make_no_figures() -> None:
    found = quality([], zero_offset_deg=0.5, position_error_mm=0.5)
    assert (found.runs, found.dtheta1.n, found.dtheta1.mean, found.pareto) == (0, 0, None, ())
    assert trend("R1", []).dtheta1.centre is None


def test_a_trend_charts_calibrations_and_shows_what_was_applied() -> None:
    points = [point(k, 0.1 + 0.01 * (k % 3)) for k in range(1, 10)]
    points.insert(5, point(20, 0.1, kind="apply"))
    found = trend("R1", points)
    assert len(found.items) == 10 and found.dtheta1.at == tuple(range(1, 10))
    assert found.dtheta1.low is not None and found.dtheta1.high is not None
    assert found.dtheta1.low < 0.1 < found.dtheta1.high
    assert len(found.dtheta1.ewma) == len(found.dtheta1.ewma_low) == 9


def test_each_effect_has_its_own_chart_the_most_frequent_first() -> None:
    def size(run: int, effect: str, value: float) -> EffectPoint:
        return EffectPoint(run=run, effect=effect, joint=1, parameter="width", unit="deg", value=value)

    found = trend("R1", [], [size(2, "scale_gain", 0.1), *(size(k, "backlash", 0.02) for k in (1, 2, 5))])
    assert [(one.effect, one.lines.at, one.values) for one in found.effects] == [
        ("backlash", (1, 2, 5), (0.02, 0.02, 0.02)),
        ("scale_gain", (2,), (0.1,)),
    ]
    assert [one.lines.centre for one in found.effects] == [pytest.approx(0.02), None]


def test_runs_of_one_type(tmp_path: Path) -> None:
    """The type of the robot file as it was when the run was made."""
    with closing(Store(tmp_path / "station.db")) as store:
        for serial, kind in (("R1", "FB-300"), ("R2", "FB-500"), ("R3", None)):
            robot = Robot(serial=serial, type=kind)
            assert Robot.from_dict(robot.to_json()).type == kind
            store.add_run(CalibrationRequest(serial, "calibrate", "Ana"), robot, [], result_of([]))
        assert [p.robot_serial for p in store.trend(limit=9, robot_type="FB-500")] == ["R2"]
        assert [run.robot_serial for run in store.calibrations(robot_type="FB-300").items] == ["R1"]
    said = CliRunner().invoke(main, ["--home", str(tmp_path), "quality", "--type", "FB-300"])
    assert said.exit_code == 0 and "good" in said.output, said.output
