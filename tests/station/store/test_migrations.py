"""Files of released versions come up to date with everything that was in them."""

from __future__ import annotations

import shutil
import sqlite3
import uuid
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from station.records import ModelDocument
from station.store.store import Store

RELEASED = Path(__file__).parent / "released"


@pytest.fixture
def migrated(tmp_path: Path) -> Iterator[Store]:
    """A file of version 0.1.0 with seven runs, one of each kind that there was."""
    file = tmp_path / "station.db"
    shutil.copy(RELEASED / "station-0.1.0.sqlite", file)
    store = Store(file)
    yield store
    store.close()


def test_every_run_of_an_old_file_keeps_its_kind_verdict_and_offsets(migrated: Store) -> None:
    runs = {run.id: run for run in migrated.calibrations().items}
    assert {n: (run.kind, run.plan, run.verdict, run.outcome) for n, run in runs.items()} == {
        1: ("calibrate", "paper", "pass", "good"),
        2: ("calibrate", "rapid", "pass", "good"),
        3: ("apply", "apply", "pass", "good"),
        4: ("rollback", "rollback", "pass", "good"),
        5: ("diagnose", "diagnostic", "pass", "repair"),
        6: ("import", "dataset", "pass", "good"),
        7: ("calibrate", "full", "pass", "good"),
    }
    assert runs[1].zero_offsets[0].value_deg == pytest.approx(1.9937, abs=1e-4)
    for n, run in runs.items():
        assert migrated.readings(n), f"run {run.id} lost its readings"


def test_results_documents_and_memories_of_an_old_file_are_read(migrated: Store) -> None:
    full = migrated.calibration(7)
    assert full.method == "measurement model"
    assert full.weak_direction is not None and "both arms together" in full.weak_direction.text
    assert full.after is not None and full.after.predicted_position_error_mm is not None
    assert len(full.residuals) == 120
    document = migrated.diagnosis(5)
    assert (document.verdict, document.findings[0].effect) == ("explained", "backlash")
    assert isinstance(document.model, ModelDocument)
    assert document.model.terms[0].effect == "backlash of joint 2"
    known = migrated.memory("R1")
    assert known is not None and known.calibration_id == 7


def test_results_are_text_that_sql_queries(migrated: Store) -> None:
    with sqlite3.connect(migrated.path) as other:
        rows = other.execute(
            "SELECT verdict, json_extract(result, '$.zero_offsets[0].value_deg') FROM calibrations"
            " JOIN results ON calibration_id = id WHERE kind = 'calibrate' ORDER BY id"
        ).fetchall()
    other.close()
    assert [verdict for verdict, _ in rows] == ["pass"] * 3
    assert [value for _, value in rows] == pytest.approx([1.9937, 2.0008, 1.9972], abs=1e-3)


def test_a_file_of_0_2_0_keeps_everything_and_gets_uids(tmp_path: Path) -> None:
    file = tmp_path / "station.db"
    shutil.copy(RELEASED / "station-0.2.0.sqlite", file)
    with closing(sqlite3.connect(file)) as old:
        columns = "id, kind, plan, state, verdict, outcome, reason_code, of_id, created_ms, ended_ms, step"
        before = old.execute(f"SELECT {columns} FROM calibrations ORDER BY id").fetchall()
        kept = "calibration_id, zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg, result, diagnosis"
        results = old.execute(f"SELECT {kept} FROM results ORDER BY calibration_id").fetchall()
        readings = old.execute("SELECT * FROM readings ORDER BY 1, 2").fetchall()
    with closing(Store(file)) as store, closing(sqlite3.connect(file)) as new:
        assert new.execute(f"SELECT {columns} FROM calibrations ORDER BY id").fetchall() == before
        assert new.execute(f"SELECT {kept} FROM results ORDER BY calibration_id").fetchall() == results
        assert new.execute("SELECT * FROM readings ORDER BY 1, 2").fetchall() == readings
        for run in store.calibrations().items:
            assert uuid.UUID(run.uid).int >> 80 == round(run.created_at.timestamp() * 1000)
        assert (len(before), len(store.zero_writes("R1"))) == (6, 4)


def test_position_errors_of_runs_that_are_there_get_a_column(migrated: Store) -> None:
    """Of those that fresh readings verified, the largest that their record names."""
    for point in migrated.trend(limit=10, kinds=("calibrate",)):
        after, accuracy = (getattr(migrated.calibration(point.id), name) for name in ("after", "accuracy"))
        predicted = after.predicted_position_error_mm
        bounds = [accuracy and accuracy.bound_95_mm, predicted and predicted.max]
        verified = after.fresh_reading_rms_mm is not None
        wanted = next((bound for bound in bounds if bound is not None), None) if verified else None
        assert point.position_error_mm == wanted


def test_what_was_found_gets_rows_of_its_own(migrated: Store) -> None:
    """The same as in the results, which stay as they are; effects of new runs come from there as well."""
    found = [
        (run.id, finding.effect, finding.joint, parameter.name, parameter.value, parameter.unit)
        for run in reversed(migrated.calibrations().items)
        for finding in migrated.calibration(run.id).findings
        for parameter in finding.parameters
    ]
    (columns,) = migrated.table("findings", 1, 7)
    names = ("run_id", "effect", "joint", "parameter", "value", "unit")
    assert found and list(zip(*(columns[name] for name in names), strict=True)) == found
    sizes = [(point.run, point.effect, point.value) for point in migrated.effects(limit=10)]
    assert sizes == [(run, effect, value) for run, effect, _, _, value, _ in found]
