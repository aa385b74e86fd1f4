"""The plain machine is the emulated one, and figures do not depend on who computes them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from drivers.emulated.spec import MachineSpec
from station.cli import main
from station.errors import InputRefused
from station.five_bar import Robot
from station.plans import make_plan
from station.studies.population import Case, calibrated
from station.studies.population.physics import PlainMachine
from station.studies.simulation import SimulatedMachine

TRUTH = np.array([0.02, -0.03, 0.1, -0.2, 0.05, 0.3, 0.2, -0.1, 0.15, -0.25, 1.1, 0.4])


class Silent(np.random.Generator):
    """No scatter and no noise."""

    def normal(self, loc: float = 0.0, scale: float = 1.0, size: object = None) -> object:  # type: ignore[override]
        return np.full(size, loc)  # type: ignore[call-overload]


def test_the_plain_machine_reads_what_the_emulated_one_reads() -> None:
    robot = Robot.default("R")
    stops = make_plan("full", robot).stops
    ours = PlainMachine(robot, TRUTH).read(stops, Silent(np.random.PCG64(1)))
    theirs = SimulatedMachine(robot, TRUTH, "exact", 1, noise=False).run(stops)
    assert ours.theta == pytest.approx(theirs.theta, abs=1e-12)
    assert ours.distance == pytest.approx(theirs.distance, abs=1e-9)
    assert (ours.position == theirs.position).all() and (ours.approach == theirs.approach).all()


def test_its_noise_and_scatter_are_those_that_the_paper_specifies() -> None:
    robot = Robot.default("R")
    stop = make_plan("full", robot).stops[0]
    taken = PlainMachine(robot, TRUTH).read((stop,) * 4000, np.random.default_rng(5))
    spec = MachineSpec()
    pulses = np.degrees(taken.theta - taken.theta.mean(axis=0)) * spec.pulses_per_deg
    # whole pulses add the variance of a uniform distribution
    assert pulses.std() == pytest.approx(((4 / 3) ** 2 + 1 / 12) ** 0.5, rel=0.03)
    still = PlainMachine(robot, TRUTH)
    foot = complex(robot.c[0] + robot.d[0] + 1.1, robot.c[1] + robot.d[1] + 0.4)
    bare = np.abs(still.stand(taken.theta) - foot)
    noise = taken.distance - bare + spec.head_zero_mm
    assert noise.std() == pytest.approx(spec.scale_noise_mm / 5**0.5, rel=0.04)


def study(*args: str) -> None:
    result = CliRunner(catch_exceptions=False).invoke(main, ["study", *args])
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize("kind", ["accuracy", "coverage", "capability"])
def test_a_study_states_its_figures_and_their_digest(tmp_path: Path, kind: str) -> None:
    file = tmp_path / "out.json"
    study(kind, "--machines", "6", "--seed", "4", "--workers", "1", "--json", str(file))
    found = json.loads(file.read_text())
    assert found.keys() == {"study", "machines", "seed", "digest", "seconds", "figures"}
    assert (found["study"], found["machines"], found["figures"]["machines"]) == (kind, 6, 6)
    again = tmp_path / "again.json"
    study(kind, "--machines", "6", "--seed", "4", "--json", str(again))
    assert json.loads(again.read_text())["digest"] == found["digest"]
    study(kind, "--machines", "6", "--seed", "5", "--json", str(again))
    assert json.loads(again.read_text())["digest"] != found["digest"]


def test_a_cluster_that_loses_a_worker_finds_the_same_and_a_missing_one_is_said() -> None:
    script = [sys.executable, "-m", "tests.station.studies.population.cluster"]
    done = subprocess.run(script, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr[-2000:]


def test_a_machine_that_is_refused_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise InputRefused("no")

    monkeypatch.setattr("station.studies.population.one.identify", refuse)
    assert calibrated(Case(1, "full", 0.03)) is None
    result = CliRunner().invoke(main, ["study", "accuracy", "--machines", "2"])
    assert (result.exit_code, "None of 2 machines" in result.output) == (2, True)
