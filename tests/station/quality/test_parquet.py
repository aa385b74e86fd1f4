"""The history as Parquet: partitions, only what is new, nothing twice after an export that was cut off."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import duckdb
import pytest
from click.testing import CliRunner
from pyarrow import parquet

from station.cli import main
from station.five_bar import Robot
from station.quality import export_parquet
from station.records import CalibrationRequest, Reading
from station.store import Store
from tests.station.asking import result
from tests.station.fakes import result_of

ROBOT = Robot.default("R1")
READINGS = [Reading(k, float(k), (1.0, 2.0), (1, -1), 100.0 + k, f"P{k}", 1) for k in range(1, 5)]


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with closing(Store(tmp_path / "station.db")) as opened:
        yield opened


def add(store: Store, count: int = 1) -> None:
    for _ in range(count):
        store.add_run(CalibrationRequest("R1", "calibrate", "Ana"), ROBOT, READINGS, result_of(READINGS))


def export(store: Store, folder: Path) -> tuple[int, int, int]:
    found = export_parquet(store, folder, "Line 4", lambda _: None)
    return found.runs, found.readings, found.last


def ask(folder: Path, table: str, what: str) -> list[tuple[object, ...]]:
    files = folder / table / "**" / "*.parquet"
    with duckdb.connect() as db:
        return db.execute(f"SELECT {what} FROM read_parquet('{files}', hive_partitioning = true)").fetchall()


def test_runs_and_readings_stand_in_partitions(store: Store, tmp_path: Path) -> None:
    add(store, 3)
    assert export(store, tmp_path / "out") == (3, 12, 3)
    assert ask(tmp_path / "out", "runs", "count(*), min(dtheta1_deg), any_value(station)") == [
        (3, 0.5, "Line 4")
    ]
    assert ask(tmp_path / "out", "readings", "sum(scale_mm), count(DISTINCT run_uid)") == [(3 * 410.0, 3)]
    month = str(store.summary(1).created_at)[:7]
    assert (tmp_path / "out" / "runs" / "station=Line%204" / f"month={month}").is_dir()


def test_findings_have_a_row_a_parameter(store: Store, tmp_path: Path) -> None:
    parameters = [
        {"name": "width", "value": 0.01, "sd": 0.001, "unit": "deg"},
        {"name": "rest", "value": 2, "sd": 0.5, "unit": "mm"},
    ]
    about = {"label": "", "share": 0.5, "p_value": 0.25, "alias_set": [], "remedy": ""}
    findings = [
        {"effect": "backlash", "joint": 2, "probability": 0.9, "parameters": parameters, **about},
        {"effect": "drift", "parameters": [], **about},
    ]
    found = result_of(READINGS).model_copy(update={"findings": result(findings=findings).findings})
    add(store)
    store.add_run(CalibrationRequest("R2", "diagnose", "Ana"), ROBOT, READINGS, found)
    export(store, tmp_path / "out")
    what = "run_id, robot_serial, effect, joint, probability, p_value, parameter, value, sd, unit"
    assert ask(tmp_path / "out", "findings", what) == [
        (2, "R1", "backlash", 2, 0.9, 0.25, "width", 0.01, 0.001, "deg"),
        (2, "R1", "backlash", 2, 0.9, 0.25, "rest", 2.0, 0.5, "mm"),
    ]
    assert ask(tmp_path / "out", "findings", "any_value(run_uid)") == [(store.summary(2).uid,)]


def test_the_schema_is_the_documented_one(store: Store, tmp_path: Path) -> None:
    """`station.export/1`: columns may be added; their order and types stay."""
    add(store)
    export(store, tmp_path / "out")
    (file,) = (tmp_path / "out" / "readings").rglob("*.parquet")
    schema = parquet.read_schema(file)
    assert schema.metadata[b"schema"] == b"station.export/1"
    assert [(field.name, str(field.type)) for field in schema][:8] == [
        ("run_id", "int64"),
        ("run_uid", "string"),
        ("robot_serial", "string"),
        ("created_at", "timestamp[ms, tz=UTC]"),
        ("reading", "int64"),
        ("sequence", "int64"),
        ("t_s", "double"),
        ("theta1_deg", "double"),
    ]


def test_again_only_what_is_new(store: Store, tmp_path: Path) -> None:
    add(store, 2)
    export(store, tmp_path / "out")
    assert export(store, tmp_path / "out") == (0, 0, 2)
    add(store)
    assert export(store, tmp_path / "out") == (1, 4, 3)
    assert ask(tmp_path / "out", "runs", "list(id ORDER BY id)") == [([1, 2, 3],)]


def test_a_run_under_way_holds_back_those_after_it(store: Store, tmp_path: Path) -> None:
    add(store)
    store.create(CalibrationRequest("R1", "calibrate", "Ana"), ROBOT)
    add(store)
    assert export(store, tmp_path / "out") == (1, 4, 1)


def test_nothing_is_there_twice_after_an_export_that_was_cut_off(store: Store, tmp_path: Path) -> None:
    add(store, 2)
    export(store, tmp_path / "out")
    for file in (tmp_path / "out" / "runs").rglob("*.parquet"):
        file.unlink()
    add(store)
    assert export(store, tmp_path / "out") == (3, 12, 3)
    assert ask(tmp_path / "out", "readings", "count(*)") == [(12,)]


def test_from_the_terminal(store: Store, tmp_path: Path) -> None:
    add(store)
    command = ["--home", str(tmp_path), "export"]
    said = CliRunner().invoke(main, [*command, "--parquet", str(tmp_path / "out")])
    assert said.exit_code == 0 and "1 runs, 4 readings" in said.stdout, said.output
    one = CliRunner().invoke(main, [*command, "1"])
    assert one.exit_code == 0 and one.stdout.startswith("reading,t_s,")
    assert CliRunner().invoke(main, command).exit_code == 2
