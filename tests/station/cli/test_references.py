"""References on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from station.cli import main
from station.plans import make_plan
from station.records import Reading, readings_to_csv
from station.studies.drawn import drawn, robot_of

DATA_ROBOT = robot_of(0.03)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    stops = make_plan("rapid", DATA_ROBOT).stops
    m = drawn(DATA_ROBOT, 1)[0].machine().measure(stops)
    readings = [
        Reading(
            k + 1,
            float(m.t_s[k]),
            tuple(m.theta[k] * 57.29577951308232),
            (0, 0),
            float(m.distance[k]),
            s.position,
        )
        for k, s in enumerate(stops)
    ]
    file = tmp_path_factory.mktemp("data") / "six.csv"
    file.write_text(readings_to_csv(readings))
    return file


def test_they_take_part(data: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.json"
    plain = CliRunner().invoke(main, ["identify", str(data), "--json", str(out)])
    assert plain.exit_code == 0, plain.output
    without = json.loads(out.read_text())
    seen = f"joint=1,at=0,reads={without['zero_offsets'][0]['value_deg']},sd=0.005"
    result = CliRunner().invoke(
        main,
        ["identify", str(data), "--reference", seen, "--reference", "drm_x=1.02,sd=0.02", "--json", str(out)],
    )
    assert result.exit_code == 0, result.output
    found = json.loads(out.read_text())
    assert found["zero_offsets"][0]["sd_deg"] < 0.006 < 0.03 < without["zero_offsets"][0]["sd_deg"]
    assert [use["reference"]["kind"] for use in found["references"]] == ["joint_angle", "drm_x"]
    assert "from the value of all other data" in result.output


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("joint=1,at=0", "is not understood"),
        ("joint=three,at=0,reads=0,sd=1", "joint must be 1 or 2"),
        ("joint=3,at=0,reads=0,sd=1", "joint"),
        ("joint=1,at=0,reads=0,sd=0", "sd_deg"),
        ("drm_z=1,sd=1", "kind"),
        ("drm_x=1,drm_x=2", "is not understood"),
        ("nonsense", "is not understood"),
    ],
)
def test_what_is_no_reference_is_refused_in_one_line(data: Path, text: str, words: str) -> None:
    result = CliRunner().invoke(main, ["identify", str(data), "--reference", text])
    assert result.exit_code == 2
    assert words in result.output
    assert len(result.output.strip().splitlines()) == 1


@pytest.mark.parametrize("text", ["0", "-1mm", "wide", "inf"])
def test_a_length_must_be_one(text: str, tmp_path: Path) -> None:
    result = CliRunner().invoke(main, ["--home", str(tmp_path), "calibrate", "--until", text])
    assert result.exit_code == 2
