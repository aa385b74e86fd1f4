"""Arms' logs as runs: kept to the byte, their diagnosis beside them, refusals that leave nothing behind."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from station.cli import main
from station.errors import NotApplicable
from station.five_bar import Robot
from station.machines import read_log
from station.records import ColumnMap, sections_to_toml
from station.serial_arm import Arm
from station.store import Store
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses

MAP = """decimal = ","
[columns]
theta_deg = ["a1", "a2", "a3", "a4", "a5", "a6"]
tracker_mm = ["x", "y", "z"]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log of 48 poses of an arm with nothing to find, its map and its robot file."""
    where = tmp_path_factory.mktemp("arm")
    arm = random_arm(UR_LIKE, 31)
    m = arm.log(random_poses(6, 48, 31), 31)
    assert m.tracker is not None
    rows = np.column_stack([np.degrees(m.theta), m.tracker])
    lines = [";".join(f"{v:.6f}" for v in row).replace(".", ",") for row in rows]
    (where / "log.csv").write_text("\n".join(["a1;a2;a3;a4;a5;a6;x;y;z", *lines]))
    (where / "map.toml").write_text(MAP)
    (where / "arm.toml").write_text(sections_to_toml(arm.robot.to_json()))
    return where


def station(folder: Path, home: Path, *words: str) -> Result:
    return CliRunner().invoke(main, ["--home", str(home), *(w.replace("@", f"{folder}/") for w in words)])


@pytest.fixture(scope="module")
def home(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    where = tmp_path_factory.mktemp("home")
    said = station(
        folder, where, "import", "@log.csv", "--robot", "@arm.toml", "--columns", "@map.toml", "--hold-out"
    )
    assert said.exit_code == 0, said.output
    assert "Run 1: pass." in said.output
    return where


@pytest.fixture
def store(home: Path) -> Iterator[Store]:
    with closing(Store(home / "station.db", read_only=True)) as opened:
        yield opened


def test_the_run_has_its_diagnosis_and_every_zero_offset(store: Store) -> None:
    run = store.calibration(1)
    assert (run.robot_serial, run.kind, run.outcome, run.step, run.steps) == ("A6", "import", "good", 48, 48)
    assert [offset.joint for offset in run.zero_offsets] == [1, 2, 3, 4, 5, 6]
    document = store.diagnosis(1)
    assert (document.verdict, document.confirmed, document.data.readings) == ("adequate", True, 48)
    assert len(run.residuals) == 36  # a quarter was held out
    kept = store.log_documents(1)
    assert kept is not None
    assert len(json.loads(kept.residuals)["items"]) == 36
    assert kept.report.startswith("<!doctype html>")


def test_the_log_comes_back_to_the_byte_and_can_be_read_again(store: Store, folder: Path) -> None:
    (log,) = store.logs_of(1)
    assert log.content == (folder / "log.csv").read_bytes()
    arm = Arm.from_dict(store.robot_file_of(1))
    mapping = ColumnMap.model_validate_json(log.columns)
    assert len(read_log(arm, log.content, log.name, log.measured, mapping=mapping)) == 48


def test_the_log_is_part_of_the_chained_record(
    store: Store, folder: Path, home: Path, tmp_path: Path
) -> None:
    assert store.verify().runs == 1
    chained = store.chained(1)
    assert chained is not None
    assert chained.record["version"] == 4
    assert station(folder, home, "backup", str(tmp_path / "copy.db")).exit_code == 0
    with closing(Store(tmp_path / "copy.db")) as copy, copy._writing() as db:
        db.execute("UPDATE logs SET name = 'other.csv'")
    with closing(Store(tmp_path / "copy.db", read_only=True)) as changed:
        broken = changed.verify().broken
    assert broken is not None and broken.why == "it is not as it ended"


def test_what_is_for_five_bars_is_refused_in_words(store: Store) -> None:
    with pytest.raises(NotApplicable, match=r"model serial-dh\. Its logs can be imported"):
        store.robot_of(1)


def test_an_arm_does_not_take_the_serial_of_a_five_bar(folder: Path, tmp_path: Path) -> None:
    with closing(Store(tmp_path / "station.db")) as store:
        store.save_robot(Robot.default("A6"))
    said = station(folder, tmp_path, "import", "@log.csv", "--robot", "@arm.toml", "--columns", "@map.toml")
    assert said.exit_code == 2
    assert "Robot A6 is kept as a machine of model five-bar" in said.output
    with closing(Store(tmp_path / "station.db")) as store:
        assert store.calibrations().items == []


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["@log.csv", "--robot", "@arm.toml"], "`station columns log.csv` proposes a column map"),
        (["@log.csv", "--robot", "@arm.toml", "--columns", "@arm.toml"], "[robot] Extra inputs"),
        (["@log.csv", "--hold-out"], "--hold-out is for logs of arms"),
        (
            [
                "@log.csv",
                "--robot",
                "@arm.toml",
                "--columns",
                "@map.toml",
                "--hold-out",
                "--confirm",
                "@log.csv",
            ],
            "judge by one of them",
        ),
    ],
    ids=["no map", "no map file", "five-bar", "both"],
)
def test_a_refusal_leaves_no_run(folder: Path, tmp_path: Path, words: list[str], text: str) -> None:
    said = station(folder, tmp_path, "import", *words)
    assert said.exit_code == 2
    assert text in " ".join(said.output.split())
    if (tmp_path / "station.db").exists():
        with closing(Store(tmp_path / "station.db")) as store:
            assert store.calibrations().items == []
