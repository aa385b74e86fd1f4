"""Gauge studies: published examples to the printed digits, intervals that hold the truth, refusals."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli import main
from station.errors import InputRefused
from station.quality import GaugeStudy, anova, gauge_sd, gauge_study, joint_gauge
from station.records import Real

# AIAG, Measurement Systems Analysis, 4th edition: ten parts, three appraisers with three trials each.
AIAG = """
0.29 -0.56 1.34 0.47 -0.80 0.02 0.59 -0.31 2.26 -1.36
0.41 -0.68 1.17 0.50 -0.92 -0.11 0.75 -0.20 1.99 -1.25
0.64 -0.58 1.27 0.64 -0.84 -0.21 0.66 -0.17 2.01 -1.31
0.08 -0.47 1.19 0.01 -0.56 -0.20 0.47 -0.63 1.80 -1.68
0.25 -1.22 0.94 1.03 -1.20 0.22 0.55 0.08 2.12 -1.62
0.07 -0.68 1.34 0.20 -1.28 0.06 0.83 -0.34 2.19 -1.50
0.04 -1.38 0.88 0.14 -1.46 -0.29 0.02 -0.46 1.77 -1.49
-0.11 -1.13 1.09 0.20 -1.07 -0.67 0.01 -0.56 1.45 -1.77
-0.15 -0.96 0.67 0.11 -1.45 -0.49 0.21 -0.49 1.87 -2.16
"""


def study_of(values: Real) -> GaugeStudy:
    """Of values (parts, operators, trials)."""
    p, o, _ = (index.ravel() for index in np.indices(values.shape))
    return gauge_study([str(k) for k in p], [str(k) for k in o], values.ravel())


def aiag() -> Real:
    rows = np.array([[float(v) for v in line.split()] for line in AIAG.split("\n") if line])
    return rows.reshape(3, 3, 10).transpose(2, 0, 1)


def test_the_example_of_the_aiag_manual() -> None:
    found = study_of(aiag())
    printed = {"ev": 0.199933, "av": 0.226838, "grr": 0.302373, "pv": 1.042327}
    for name, value in printed.items():
        assert getattr(found, name) == pytest.approx(value, abs=2e-6)
    shares = {"ev_percent": 18.4, "av_percent": 20.9, "grr_percent": 27.9, "pv_percent": 96.0}
    for name, value in shares.items():
        assert round(getattr(found, name), 1) == value
    assert found.ndc == 4 and found.interaction_pooled
    squares = {row.source: row.sum_of_squares for row in found.anova}
    assert squares["part"] == pytest.approx(88.3619, abs=5e-5)
    assert squares["operator"] == pytest.approx(3.1673, abs=5e-5)


def test_a_case_solved_by_hand() -> None:
    """Two parts ten apart, two operators one apart, trials two apart: nothing interacts."""
    value = np.array([[[0.0, 2.0], [1.0, 3.0]], [[10.0, 12.0], [11.0, 13.0]]])
    found = study_of(value)
    # repeats: 4 cells of 2 with sum of squares 2, and an interaction of 0 with its one degree of freedom
    assert found.ev == pytest.approx(np.sqrt(8.0 / 5.0))
    assert found.av == pytest.approx(np.sqrt((2.0 - 1.6) / 4.0))
    assert found.pv == pytest.approx(np.sqrt((200.0 - 1.6) / 4.0))


def test_an_interaction_is_kept() -> None:
    rng = np.random.default_rng(1)
    value = rng.normal(0, 1, (10, 3, 1)) + rng.normal(0, 0.05, (10, 3, 3))
    found = study_of(value)
    assert not found.interaction_pooled
    assert [row.source for row in found.anova] == ["part", "operator", "part x operator", "repeatability"]
    assert found.ev == pytest.approx(0.05, rel=0.2) and found.av > 0.4


def few_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    """So many that the coverage is not changed by a percent, and many studies take a second."""
    monkeypatch.setattr(anova, "DRAWS", 2000)
    anova._chi_squares.cache_clear()
    monkeypatch.setattr(anova, "_chi_squares", lru_cache(anova._chi_squares.__wrapped__))


def test_intervals_hold_the_truth(monkeypatch: pytest.MonkeyPatch) -> None:
    """95 % intervals of 500 random studies."""
    few_draws(monkeypatch)
    held = dict.fromkeys(("ev", "av", "grr", "pv", "grr_percent"), 0)
    truth = {"ev": 0.2, "av": 0.25, "grr": np.hypot(0.2, 0.25), "pv": 1.0}
    truth["grr_percent"] = 100.0 * truth["grr"] / np.hypot(truth["grr"], 1.0)
    rng = np.random.default_rng(2)
    for _ in range(500):
        parts, operators = rng.normal(0, 1.0, (10, 1, 1)), rng.normal(0, 0.25, (1, 3, 1))
        found = study_of(parts + operators + rng.normal(0, 0.2, (10, 3, 3)))
        for name in held:
            held[name] += found.intervals[name].low <= truth[name] <= found.intervals[name].high
    assert all(0.93 <= count / 500 <= 0.97 for count in held.values()), held


def drawn_values(rng: np.random.Generator, shape: tuple[int, int, int, int], sd: Sequence[float]) -> Real:
    """Robots, operators, mountings and repeats that scatter so."""
    p, o, m, r = shape
    shapes = ((p, 1, 1, 1), (1, o, 1, 1), (p, o, m, 1), (p, o, m, r))
    parts = [rng.normal(0.0, s, of) for s, of in zip(sd, shapes, strict=True)]
    return np.asarray(sum(np.broadcast_to(part, shape) for part in parts))


@pytest.mark.parametrize("robots", [1, 5])
def test_intervals_of_a_station_hold_the_truth(robots: int, monkeypatch: pytest.MonkeyPatch) -> None:
    few_draws(monkeypatch)
    rng = np.random.default_rng(robots)
    sd = (1.0, 0.25, 0.2, 0.1)
    truth = {"repeat": 0.1, "mounting": 0.2, "ev": np.hypot(0.2, 0.1), "av": 0.25}
    truth["grr"] = np.hypot(truth["ev"], 0.25)
    held = dict.fromkeys(truth, 0)
    for _ in range(500):
        found = joint_gauge(1, drawn_values(rng, (robots, 3, 4, 2), sd), 6.0)
        for name in held:
            held[name] += found.intervals[name].low <= truth[name] <= found.intervals[name].high
    assert all(0.93 <= count / 500 <= 0.98 for count in held.values()), held


def test_a_station_by_hand() -> None:
    """Two operators 4 apart, mountings 2 apart, repeats 1 apart: mean squares 32, 4 and 0.5."""
    value = np.array([[[[0.0, 1.0], [2.0, 3.0]], [[4.0, 5.0], [6.0, 7.0]]]])
    found = joint_gauge(2, value, 60.0)
    assert [(row.source, row.dof, row.mean_square) for row in found.anova] == [
        ("operator", 1, 32.0),
        ("mounting", 2, 4.0),
        ("repeat", 4, 0.5),
    ]
    variances = {
        "repeat": 0.5,
        "mounting": 1.75,
        "ev": 2.25,
        "av": 7.0,
        "grr": 9.25,
        "pv": 90.75,
        "tv": 100.0,
    }
    for name, variance in variances.items():
        assert getattr(found, name) ** 2 == pytest.approx(variance)
    assert (found.against, found.ndc, found.interaction_p_value) == ("tolerance", 4, None)
    assert gauge_sd(value[..., None]) == pytest.approx([np.sqrt(9.25)])


@pytest.mark.parametrize(
    ("part", "operator", "value", "text"),
    [
        ("aabb", "xyxy", [1, 2, 3, 4], "needs 2 trials"),
        ("aabbb", "xyxyy", [1, 2, 3, 4, 5], "Operator y measured part b 2 times"),
        ("aaaa", "xxyy", [1, 2, 3, 4], "needs 2 parts"),
        ("aabb", "xxxx", [1, 2, 3, 4], "needs 2 operators"),
        ("aaaabbbb", "xxyyxxyy", [1] * 8, "All values are equal"),
    ],
)
def test_what_is_no_study_is_refused(part: str, operator: str, value: list[float], text: str) -> None:
    with pytest.raises(InputRefused, match=text):
        gauge_study(list(part), list(operator), np.array(value, dtype=float))


def test_from_the_terminal(tmp_path: Path) -> None:
    data, out = tmp_path / "study.csv", tmp_path / "out.json"
    values = aiag()
    rows = ["part,operator,trial,value"]
    rows += [f"{p},{o},{t},{values[p, o, t]}" for p, o, t in np.ndindex(values.shape)]
    data.write_text("\n".join(rows))
    said = CliRunner().invoke(main, ["gauge-study", str(data), "--json", str(out)])
    assert said.exit_code == 0, said.output
    assert "distinguishes 4 categories" in " ".join(said.output.split())
    document = json.loads(out.read_text())
    assert {"ev", "av", "grr", "pv", "tv", "grr_percent", "ndc", "anova", "intervals"} <= set(document)
    data.write_text("\n".join([*rows, rows[5]]))
    twice = CliRunner().invoke(main, ["gauge-study", str(data)])
    assert (twice.exit_code, "was given in row 6 already" in twice.output) == (2, True)
