"""Commands under the identified model, and what the true machine does with them."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli import main
from station.diagnosis.explanations import Around
from station.diagnosis.learned.commands import solve_targets
from station.diagnosis.learned.model_file import LearnedModel, read_model
from station.diagnosis.learned.targets import read_targets
from station.diagnosis.report.traced_findings import TracedFindings
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.traced_loop import traced
from station.diagnosis.weighed_loop import WeighedDiagnosis, weighed
from station.model.identified_machine import IdentifiedMachine, Situation, identified
from station.model.model import Fit
from station.records import Complex, DataSource, Real
from tests.station.simulated import ROBOT, Drawn

RUN_UP_DEG = 1.0
BACKLASH = {"kind": "backlash", "joint": 1, "width_deg": 0.05}
RIPPLE = {"kind": "gear_cyclic", "joint": 2, "amplitude_deg": 0.05, "per_rev": 20, "phase_deg": 40}


def machine_of(fit: Fit, sd_factor: float = 1.0) -> IdentifiedMachine:
    machine = identified(fit, sd_factor)
    assert machine is not None
    return machine


def learned(tmp_path: Path, effect: dict[str, Any]) -> tuple[Drawn, WeighedDiagnosis, Path]:
    """A machine with an effect, its diagnosis, and the model as a file."""
    machine = Drawn(effect, seed=2)
    diagnosis = weighed(ROBOT, machine.sequence(), machine.fresh())
    file = tmp_path / "model.json"
    data = DataSource(file="walk.csv", readings=120, sha256="0" * 64)
    file.write_text(WeighedFindings(diagnosis).document(data).model_dump_json(by_alias=True))
    return machine, diagnosis, file


def targets_file(tmp_path: Path, place: Complex, approach: Real | None) -> Path:
    rows = [f"{r.real},{r.imag}" for r in place]
    header = "x_mm,y_mm"
    if approach is not None:
        header += ",approach1,approach2"
        rows = [f"{row},{a:.0f},{b:.0f}" for row, (a, b) in zip(rows, approach, strict=True)]
    file = tmp_path / "targets.csv"
    file.write_text("\n".join([header, *rows, ""]))
    return file


def true_error_mm(machine: Drawn, place: Complex, approach: Real, theta: Real) -> Real:
    """(K,) distance of the true position from its target, approached as asked."""
    commands = np.degrees(theta)
    stops = np.stack([commands - RUN_UP_DEG * approach, commands], axis=1).reshape(-1, 2)
    return np.abs(machine.stand(stops)[1::2] - place)


def rms(values: Real) -> float:
    return float(np.sqrt(np.mean(values**2)))


@pytest.mark.parametrize(
    "effect",
    [
        BACKLASH,
        {**RIPPLE, "amplitude_deg": 0.1},
        {"kind": "encoder_eccentricity", "joint": 1, "amplitude_deg": 0.3, "phase_deg": 70},
        {"kind": "transmission_gain", "joint": 2, "ppm": 5000},
        {"kind": "link_length", "joint": 1, "link": "L", "mm": 1.5},
    ],
    ids=lambda effect: str(effect["kind"]),
)
def test_true_position_error_falls(tmp_path: Path, effect: dict[str, Any]) -> None:
    machine, diagnosis, file = learned(tmp_path, effect)
    place = np.tile(ROBOT.workspace_grid(7, 5), 2)
    approach = np.random.default_rng(0).choice([-1.0, 1.0], (len(place), 2))
    found = diagnosis.found
    before = found.mixture.only(found.base).commands(place, Around(approach))
    after = solve_targets(read_model(file), read_targets(targets_file(tmp_path, place, approach))[1])
    was = rms(true_error_mm(machine, place, approach, before))
    now = rms(true_error_mm(machine, place, approach, after))
    predicted_before, predicted_after = WeighedFindings(diagnosis).position_errors
    assert now < 0.5 * was
    assert now < 3.0 * predicted_after.rms
    # one machine of those that the readings leave possible: its error is of this size
    assert 0.5 < was / predicted_before.rms < 2.0


def old_model(tmp_path: Path, effect: dict[str, Any]) -> IdentifiedMachine:
    """One model as earlier versions found it."""
    machine = Drawn(effect, seed=2)
    return machine_of(traced(ROBOT, machine.sequence(), machine.fresh()).last)


def model_of(tmp_path: Path, effect: dict[str, Any]) -> LearnedModel:
    return read_model(learned(tmp_path, effect)[2])


def test_commands_and_positions_are_inverse(tmp_path: Path) -> None:
    for machine in (model_of(tmp_path, RIPPLE).machine, old_model(tmp_path, RIPPLE)):
        place = ROBOT.workspace_grid(9, 7)
        situation = Situation.plain(len(place))
        theta = machine.commands(place, situation)
        assert np.abs(machine.positions(theta, situation) - place).max() < 1e-4


def test_model_survives_its_file(tmp_path: Path) -> None:
    """To the last digit, after the search and after a journey through JSON."""
    _, diagnosis, file = learned(tmp_path, RIPPLE)
    place = np.array([37.0 - 701.0j, -120.0 - 640.0j])
    approach = np.array([[1.0, -1.0], [0.0, 1.0]])
    here = diagnosis.found.mixture.commands(place, Around(approach))
    there = read_model(file).machine.commands(place, Situation(approach, np.zeros(2), np.zeros(2)))
    assert np.allclose(here, there, rtol=0.0, atol=1e-12)


def test_an_old_model_file_is_still_read(tmp_path: Path) -> None:
    machine = Drawn(RIPPLE, seed=2)
    diagnosis = traced(ROBOT, machine.sequence(), machine.fresh())
    file = tmp_path / "old.json"
    data = DataSource(file="walk.csv", readings=120, sha256="0" * 64)
    file.write_text(TracedFindings(diagnosis).document(data).model_dump_json(by_alias=True))
    model = read_model(file)
    place, situation = np.array([37.0 - 701.0j]), Situation.plain(1)
    here = machine_of(diagnosis.last).commands(place, situation)
    assert np.array_equal(here, model.machine.commands(place, situation))
    assert [effect.label for effect in model.acting] == ["gear_cyclic of joint 2"]


def test_jacobian_against_differences(tmp_path: Path) -> None:
    machine = old_model(tmp_path, RIPPLE)
    theta = machine.commands(ROBOT.workspace_grid(2, 2), Situation.plain(4))
    jacobian = machine.jacobian(theta, Situation.plain(4))
    for k in range(len(machine.x)):
        step = np.zeros(len(machine.x))
        step[k] = 1e-6
        moved = [
            IdentifiedMachine(machine.robot, machine.x + s, machine.covariance, machine.terms, machine.end_s)
            for s in (step, -step)
        ]
        change = (
            moved[0].positions(theta, Situation.plain(4)) - moved[1].positions(theta, Situation.plain(4))
        ) / 2e-6
        # the ripple's own slope is left out of the closed form: 0.05 deg x 20 per turn
        assert np.allclose(jacobian[:, 0, k], change.real, rtol=0.02, atol=1e-3)
        assert np.allclose(jacobian[:, 1, k], change.imag, rtol=0.02, atol=1e-3)


def test_command_writes_what_was_asked_and_states_the_range(tmp_path: Path) -> None:
    _, _, model = learned(tmp_path, BACKLASH)
    targets = targets_file(tmp_path, np.array([0 - 700j, 100 - 650j]), np.array([[1.0, 1.0], [-1.0, 1.0]]))
    out = tmp_path / "commands.csv"
    result = CliRunner().invoke(main, ["solve", "--model", str(model), str(targets), "--csv", str(out)])
    assert result.exit_code == 0, result.output
    rows = list(csv.DictReader(io.StringIO(out.read_text())))
    assert list(rows[0]) == ["x_mm", "y_mm", "approach1", "approach2", "theta1_deg", "theta2_deg"]
    assert len(rows) == 2
    assert "Learned on joint 1 from" in result.stderr
    assert "backlash of joint 1" in result.stderr


def test_play_is_taken_out_in_the_sense_of_approach(tmp_path: Path) -> None:
    machine = model_of(tmp_path, BACKLASH).machine
    place = np.array([0 - 700j, 0 - 700j])
    situation = Situation(np.array([[1.0, 1.0], [-1.0, 1.0]]), np.zeros(2), np.zeros(2))
    above, below = np.degrees(machine.commands(place, situation))
    # coming from below the arm lags by half the play: the command goes further by as much
    assert above[0] - below[0] == pytest.approx(0.05, rel=0.03)
    assert above[1] == pytest.approx(below[1], abs=1e-6)


REFUSED = {
    "out of reach": ("x_mm,y_mm,approach1,approach2\n0,-700,1,1\n0,-2500,1,1\n", "row 3", "out of reach"),
    "beyond the range": ("x_mm,y_mm,approach1,approach2\n-420,-700,1,1\n", "row 2", "was learned from"),
    "no approach": ("x_mm,y_mm\n0,-700\n", "row 2, column approach1", "depends on it"),
    "unknown approach": ("x_mm,y_mm,approach1,approach2\n0,-700,0,1\n", "row 2", "depends on it"),
    "wrong approach": ("x_mm,y_mm,approach1,approach2\n0,-700,2,1\n", "row 2", "not a direction"),
    "not a number": ("x_mm,y_mm,approach1,approach2\n0,here,1,1\n", "column y_mm", "not a number"),
    "not finite": ("x_mm,y_mm,approach1,approach2\n0,nan,1,1\n", "column y_mm", "finite"),
    "missing column": ("x_mm,approach1,approach2\n0,1,1\n", "y_mm", "missing"),
    "short row": ("x_mm,y_mm,approach1,approach2\n0,-700\n", "row 2", "fields"),
    "empty": ("", "targets.csv", "empty"),
    "header only": ("x_mm,y_mm\n", "targets.csv", "header"),
    "semicolons": ("x_mm;y_mm\n0;-700\n", "row 1", "commas"),
}


@pytest.fixture(scope="module")
def backlash_model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return learned(tmp_path_factory.mktemp("learned"), BACKLASH)[2]


def refusal(arguments: list[str]) -> str:
    """The one line with which a command refuses its input."""
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    assert line.startswith("station: ")
    return line


@pytest.mark.parametrize("name", list(REFUSED))
def test_targets_are_refused_with_their_place(tmp_path: Path, backlash_model: Path, name: str) -> None:
    text, where, what = REFUSED[name]
    file = tmp_path / "targets.csv"
    file.write_text(text)
    line = refusal(["solve", "--model", str(backlash_model), str(file)])
    assert where in line
    assert what in line


def spoil(content: dict[str, Any], *path: str | int, value: Any) -> dict[str, Any]:
    at: Any = content
    for step in path[:-1]:
        at = at[step]
    at[path[-1]] = value
    return content


BROKEN: dict[str, tuple[tuple[str | int, ...], Any, str]] = {
    "other schema": (("model", "schema"), "station.model/9", "schema 'station.model/9'"),
    "no model": (("model",), None, "no section `model`"),
    "unknown effect": (("model", "explanations", 0, "errors", 0, "kind"), "gremlins", "not in the catalogue"),
    "not a number": (("model", "values", 0), "much", "model.values.0"),
    "values missing": (("model", "values"), [0.0], "13 values"),
    "covariance ragged": (("model", "covariance", 0), [], "covariance"),
    "amplitudes differ": (("model", "explanations", 0, "errors", 0, "amplitudes"), [7.0, 1.0], "evaluated"),
    "readings ragged": (("model", "readings", "t_s"), [0.0], "one length"),
    "robot wrong": (("model", "robot", "robot", "L"), -1.0, "model.robot"),
    "range missing": (("model", "ranges"), {}, "model.ranges.joints_deg"),
}


@pytest.mark.parametrize("name", list(BROKEN))
def test_broken_model_is_refused(tmp_path: Path, backlash_model: Path, name: str) -> None:
    path, value, said = BROKEN[name]
    file = tmp_path / "model.json"
    file.write_text(json.dumps(spoil(json.loads(backlash_model.read_text()), *path, value=value)))
    targets = targets_file(tmp_path, np.array([0 - 700j]), np.array([[1.0, 1.0]]))
    assert said in refusal(["solve", "--model", str(file), str(targets)])


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", "\x00"])
def test_what_is_no_model_is_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "model.json"
    file.write_text(text)
    targets = targets_file(tmp_path, np.array([0 - 700j]), None)
    assert "model.json" in refusal(["solve", "--model", str(file), str(targets)])
