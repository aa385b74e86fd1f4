"""Bad input: exit status 2, one sentence, nothing written."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli import main
from station.diagnosis.closed_loop import diagnose
from tests.station.simulated import ROBOT, Drawn, to_csv

MACHINE = Drawn(seed=9, recorded_temperature=False)
GOOD = to_csv(MACHINE.sequence())
LINES = GOOD.splitlines()
FRESH = to_csv(MACHINE.fresh())


def cell(row: int, column: str, value: str) -> str:
    """The good file with one cell changed; row 1 is the header."""
    lines = [line.split(",") for line in LINES]
    lines[row - 1][lines[0].index(column)] = value
    return "\n".join(map(",".join, lines)) + "\n"


def radians() -> str:
    lines = [line.split(",") for line in LINES]
    for line in lines[1:]:
        line[2:4] = [str(np.radians(float(angle))) for angle in line[2:4]]
    return "\n".join(map(",".join, lines)) + "\n"


BAD: dict[str, tuple[str, str]] = {
    "empty": ("", "is empty"),
    "header only": (LINES[0] + "\n", "no readings"),
    "missing column": (GOOD.replace("scale_mm", "scale"), "scale_mm"),
    "not a number": (cell(5, "scale_mm", "fog"), "row 5, column scale_mm"),
    "not finite": (cell(6, "theta1_deg", "nan"), "row 6, column theta1_deg"),
    "twice the same id": (cell(7, "reading", "1"), "row 7, column reading"),
    "wrong direction": (cell(8, "approach1", "3"), "row 8, column approach1"),
    "truncated": (GOOD[: len(GOOD) // 2].rsplit(",", 3)[0] + "\n", "fields"),
    "radians": (radians(), "radians"),
    "out of reach": (cell(4, "theta1_deg", "170"), "theta1_deg"),
    "semicolons": (GOOD.replace(",", ";"), "commas"),
    "binary": ("\0" * 40, "not a text file"),
    "too few readings": ("\n".join(LINES[:25]) + "\n", "Not enough data to judge: 6 more readings"),
    "no repeats": (
        "\n".join([LINES[0], *LINES[1:11], *LINES[31:76]]) + "\n",
        "Not enough data to judge: 6 more repeats",
    ),
}


MISTAKES = {"radians": "angle_unit"}
"""Files that are refused with the mistake by name."""


def refusal(arguments: list[str]) -> str:
    result = CliRunner().invoke(main, ["diagnose", *arguments])
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    *warnings, line = result.stderr.splitlines()
    assert all("is not known and is ignored" in warning for warning in warnings)
    assert line.startswith("station: ")
    assert line.endswith(".")
    return line


@pytest.mark.parametrize("name", list(BAD))
def test_bad_readings(tmp_path: Path, name: str) -> None:
    text, said = BAD[name]
    data, out = tmp_path / "walk.csv", tmp_path / "out.json"
    data.write_text(text)
    line = refusal([str(data), "--json", str(out)])
    assert said in line
    if name in MISTAKES:
        written = json.loads(out.read_text())
        assert (written["schema"], written["refused"]) == (
            "station.diagnosis/2",
            line.removeprefix("station: "),
        )
        assert written["mistake"]["kind"] == MISTAKES[name]
    else:
        assert not out.exists()


def good_file(folder: Path) -> str:
    file = folder / "good.csv"
    file.write_text(GOOD)
    return str(file)


def test_no_such_file(tmp_path: Path) -> None:
    assert "cannot be read" in refusal([str(tmp_path / "none.csv")])


def test_no_such_folder(tmp_path: Path) -> None:
    assert "no folder" in refusal([good_file(tmp_path), "--html", str(tmp_path / "none" / "page.html")])


def test_bad_robot(tmp_path: Path) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text("[robot]\nL = -3\n")
    assert "robot.L" in refusal([good_file(tmp_path), "--robot", str(robot)])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda lines: [lines[0], *FRESH.splitlines()[1:7]], "fresh readings"),
        (
            lambda lines: [lines[0] + ",mount", *(line + ",elsewhere" for line in lines[1:])],
            "mount 'elsewhere'",
        ),
    ],
    ids=["too few", "another mount"],
)
def test_bad_fresh_readings(tmp_path: Path, change: Callable[[list[str]], list[str]], said: str) -> None:
    fresh = tmp_path / "fresh.csv"
    fresh.write_text("\n".join([*change(LINES), ""]))
    assert said in refusal([good_file(tmp_path), "--confirm", str(fresh)])


def test_time_that_runs_backwards_is_left_out(tmp_path: Path) -> None:
    data, out = tmp_path / "walk.csv", tmp_path / "out.json"
    data.write_text(cell(9, "t_s", "0.001"))
    result = CliRunner().invoke(main, ["diagnose", str(data), "--json", str(out)])
    document = json.loads(out.read_text())
    assert (result.exit_code, document["verdict"], document["confirmed"]) == (1, "adequate", False)
    assert (document["mistake"]["kind"], document["mistake"]["rows"]) == ("time", [8])


def test_fresh_readings_need_what_the_effect_needs() -> None:
    warming = {"kind": "thermal_growth", "rise_k": 8, "tau_s": 100, "links_um_per_m_per_k": 12}
    machine = Drawn(warming, seed=1)
    sequence = machine.sequence()
    machine.recorded_temperature = False
    found = diagnose(ROBOT, sequence, machine.fresh())
    # without the temperature of the fresh readings its growth cannot be seen in either
    assert not found.decision.passed or found.decision.confirmed
