"""The benchmark's parts: right answers and all fields; how fast it is, no test asserts."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli import main
from station.studies.bench import peers, service, solvers
from station.studies.bench.problems import Problem
from station.studies.bench.study import TARGETS
from station.studies.bench.timing import figure, time_ms

FIELDS = {
    "identify_4x60_ms", "identify_13x60_ms", "scan_ms", "diagnose_ms", "run_http_ms", "bytes_per_run",
    "history_100k_ms", "history_1m_ms", "peers", "machine", "versions",
}  # fmt: skip


@pytest.fixture(params=sorted(solvers.PROBLEMS))
def problem(request: pytest.FixtureRequest) -> Problem:
    return solvers.PROBLEMS[request.param]()


def test_ours_agrees_with_a_general_solver(problem: Problem) -> None:
    assert solvers.agreement(problem) <= 1e-9


@pytest.mark.parametrize("name", sorted(peers.installed()))
def test_a_peer_solves_the_same_problem(problem: Problem, name: str) -> None:
    """Within a tenth of a standard deviation, or of that order where it stops short of the minimum."""
    ours = problem.solve()
    off = (peers.installed()[name](problem)() - ours.x) / np.sqrt(np.diag(ours.covariance))
    assert np.abs(off).max() < 0.1


def test_a_figure_is_median_smallest_and_number() -> None:
    assert figure([3.0, 1.0, 2.0]) == {"median": 2.0, "min": 1.0, "n": 3}
    calls: list[int] = []
    assert time_ms(lambda: calls.append(1), seconds=0.0)["n"] == 5
    assert len(calls) == 6


def test_runs_and_history_over_http(monkeypatch: pytest.MonkeyPatch) -> None:
    """Six steps stored a run, fewer bytes than promised, and a first page of 50 whatever lies behind it."""
    monkeypatch.setattr(service, "RUNS", 20)
    monkeypatch.setattr(service, "WARM_UP", 2)
    measured = service.runs()
    assert measured["run_http_ms"]["n"] == 20
    assert measured["bytes_per_run"]["median"] > 0
    assert service.history(300)["page_bytes"] < 50_000


def test_the_command_writes_the_contracts_fields(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one: dict[str, Any] = {"median": 1.0, "min": 0.5, "n": 3}
    content = dict.fromkeys(TARGETS, one) | {
        "scan_ms": None,
        "targets": TARGETS,
        "peers": {"other": {"identify_4x60_ms": one}},
        "agreement": {"identify_4x60": 1e-14},
        "machine": {"load_1min": 0.1},
        "versions": {},
    }
    monkeypatch.setattr("station.cli.bench.bench", lambda console, quick: content)
    answer = CliRunner().invoke(main, ["bench", "--json", str(tmp_path / "b.json")], catch_exceptions=False)
    assert answer.exit_code == 0
    assert "not measured" in answer.output
    assert set(json.loads((tmp_path / "b.json").read_text())) >= FIELDS
