"""Stored runs fitted again: the same software says the same, and every difference is named."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from rich.console import Console

from station.cli import main
from station.errors import NotFound
from station.five_bar import Robot
from station.records import AnyReference, CalibrationRequest, JointAngle, PlanName
from station.run_kinds import RUN_KINDS, Start
from station.store import Store
from station.studies.engine import Engine
from station.studies.refit import Refitted, candidates, refit
from station.studies.scale.simulated_runs import add_simulated
from station.studies.simulation import SimulatedMachine
from tests.station.simulated import carried_out, group

ROBOT = Robot.default("R1")
QUIET = Engine(Console(quiet=True), workers=1)


def keep(store: Store, plan: PlanName, seed: int, *references: AnyReference) -> int:
    """A simulated run of a plan, stored as the station stores it."""
    request = CalibrationRequest("R1", "calibrate", "Ana", plan=plan, references=references)
    procedure = RUN_KINDS["calibrate"].procedure
    assert procedure is not None
    machine = SimulatedMachine(ROBOT, group(seed + 1), "exact", seed)
    readings, result = carried_out(machine, procedure(Start(store, request, ROBOT.informed(references))))
    return store.add_run(request, ROBOT, readings, result)


@pytest.fixture
def history(tmp_path: Path) -> Iterator[Path]:
    path = tmp_path / "station.db"
    with closing(Store(path)) as store:
        for seed, plan in enumerate(("full", "rapid", "paper")):
            keep(store, plan, seed)
    yield path


def of(path: Path, *ids: int) -> Refitted:
    with closing(Store(path, read_only=True)) as store:
        runs = candidates(store, ids)
    return refit(path, runs, QUIET)


def test_the_same_software_says_the_same(history: Path) -> None:
    before = history.read_bytes()
    found = of(history)
    assert (found.runs, found.left_out, found.changed) == (3, 0, ())
    assert history.read_bytes() == before


def test_what_would_change_is_named_with_both_reasons(history: Path) -> None:
    with closing(sqlite3.connect(history)) as db, db:
        db.execute("UPDATE calibrations SET verdict = 'fail', outcome = 'unexplained', reason = 'Older.'")
        db.execute("UPDATE results SET zero1_deg = zero1_deg + 0.1 WHERE calibration_id = 2")
    found = of(history)
    assert {(change.id, change.what) for change in found.changed} >= {
        (1, "outcome"), (2, "outcome"), (3, "outcome"), (2, "offsets")
    }  # fmt: skip
    outcome = next(change for change in found.changed if change.what == "outcome")
    assert outcome.reason.startswith("Then: Older. Now: ")


def test_a_diagnosis_says_the_same_and_its_changed_causes_are_named(tmp_path: Path) -> None:
    path = tmp_path / "station.db"
    with closing(Store(path)) as store:
        assert add_simulated(store, "diagnose", 1, 1, 1, QUIET) == 1
        causes = [f"{finding.effect} {finding.part}" for finding in store.calibration(1).findings]
    assert causes
    changed = tmp_path / "changed.db"
    shutil.copy(path, changed)
    with closing(sqlite3.connect(changed)) as db, db:
        db.execute("UPDATE results SET result = json_set(result, '$.findings[0].effect', 'drift')")
    assert (of(path).runs, of(path).changed) == (1, ())
    (change,) = of(changed).changed
    assert (change.what, change.after) == ("causes", causes)


def test_the_references_of_a_run_take_part_again(history: Path) -> None:
    with closing(Store(history)) as store:
        seen = JointAngle(joint=1, at_deg=0.0, reads_deg=float(np.degrees(group(1)[0])), sd_deg=0.005)
        run = keep(store, "full", 0, seen)
    assert of(history, run).changed == ()


def test_a_run_whose_readings_are_not_of_its_procedure_is_left_out(history: Path) -> None:
    with closing(sqlite3.connect(history)) as db, db:
        db.execute("DELETE FROM readings WHERE calibration_id = 1 AND walk = 2")
    found = of(history, 1, 2)
    assert (found.runs, found.left_out) == (1, 1)


def test_an_unknown_run_is_refused(history: Path) -> None:
    with closing(Store(history, read_only=True)) as store, pytest.raises(NotFound):
        candidates(store, (99,))


def test_from_the_terminal(history: Path) -> None:
    said = CliRunner().invoke(main, ["--home", str(history.parent), "refit", "--all", "--workers", "1"])
    assert said.exit_code == 0 and "3 runs fitted again" in said.stdout, said.output
    nothing = CliRunner().invoke(main, ["--home", str(history.parent), "refit"])
    assert (nothing.exit_code, "give --all" in nothing.output) == (2, True)
