"""Evidence of tampering: every change of a finished run is found, retention and new runs are none."""

from __future__ import annotations

import hashlib
import shutil
import sqlite3
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
import rfc8785
from click.testing import CliRunner

from station.cli import main
from station.errors import NotFound
from station.five_bar.robot_file import Robot
from station.records import Quantity, Reading, State
from station.store.store import Store
from tests.station.asking import asked, result

READING = Reading(1, 1.25, (0.5, 179.9), (1, -1), 12.3456, "p1", 1, (12.3455, 12.3457))
RESULT = result(zero_offsets=(Quantity("dtheta1", 0.5, 0.1, "deg"), Quantity("dtheta2", -0.5, 0.1, "deg")))


def run_of(store: Store, state: State = State.SUCCEEDED) -> int:
    run = store.create(asked("R1", "rapid"), Robot.default("R1"))
    store.add_readings(run, [READING])
    store.finish(run, state, RESULT if state is State.SUCCEEDED else None)
    return run


@pytest.fixture
def three(store: Store) -> Store:
    for state in (State.SUCCEEDED, State.ABORTED, State.SUCCEEDED):
        run_of(store, state)
    return store


def change(store: Store, sql: str) -> None:
    """Somebody with a tool of their own."""
    with closing(sqlite3.connect(store.path)) as other, other:
        assert other.execute(sql).rowcount >= 1


def verify(store: Store, head: str | None = None) -> tuple[int, str]:
    noted = ["--head", head] if head else []
    result = CliRunner().invoke(main, ["--home", str(store.path.parent), "verify", *noted])
    return result.exit_code, result.output


def test_runs_as_they_ended_are_whole_and_the_head_moves_on(three: Store) -> None:
    first = three.verify()
    assert (first.runs, first.older, first.broken) == (3, 0, None)
    code, output = verify(three)
    assert (code, output) == (0, f"3 runs are as they ended. Head of the chain: {first.head}\n")
    run_of(three)
    three.create(asked("R1", "rapid"), Robot.default("R1"))
    second = three.verify()
    assert (second.runs, second.broken, second.head == first.head) == (4, None, False)


CHANGES = [
    "UPDATE readings SET scale_mm = scale_mm + 1e-9 WHERE calibration_id = 2",
    "UPDATE readings SET theta2_deg = 180 WHERE calibration_id = 2",
    "UPDATE readings SET position = 'p2' WHERE calibration_id = 2",
    "DELETE FROM readings WHERE calibration_id = 2",
    "UPDATE readings SET samples = '[0,0]' WHERE calibration_id = 2",
    "UPDATE calibrations SET verdict = 'pass', state = 'succeeded' WHERE id = 2",
    "UPDATE calibrations SET operator = 'eve' WHERE id = 2",
    "UPDATE calibrations SET uid = '0' WHERE id = 2",
    "UPDATE calibrations SET ended_ms = ended_ms + 1 WHERE id = 2",
    "INSERT INTO results (calibration_id, result) VALUES (2, '{}')",
    "DELETE FROM calibrations WHERE id = 2",
    "DELETE FROM chain WHERE run_id = 2",
    "UPDATE chain SET hash = '0' WHERE run_id = 2",
]


@pytest.mark.parametrize("sql", CHANGES)
def test_the_first_run_that_was_changed_is_named(three: Store, sql: str) -> None:
    uid = three.summary(2).uid
    change(three, sql)
    found = three.verify().broken
    assert found is not None
    # without its link the run after it is the first that does not follow
    named = 3 if "DELETE FROM chain" in sql else 2
    assert found.id == named
    code, output = verify(three)
    assert code == 1
    assert output.startswith(f"Run {named}, uid {uid if named == 2 else three.summary(3).uid}: ")


def test_a_robot_file_that_was_changed_breaks_its_runs(three: Store) -> None:
    change(three, "UPDATE robots SET file = replace(file, '375', '376')")
    found = three.verify()
    assert (found.runs, found.broken and found.broken.id) == (0, 1)


def test_a_run_that_was_slipped_in_is_named(three: Store) -> None:
    change(
        three,
        "INSERT INTO calibrations"
        " (robot_id, robot_serial, kind, plan, operator, state, verdict, created_ms, uid)"
        " SELECT robot_id, robot_serial, kind, plan, operator, state, verdict, created_ms, 'x'"
        " FROM calibrations WHERE id = 1",
    )
    found = three.verify().broken
    assert found is not None and (found.id, found.why) == (4, "it is not in the chain")


def test_a_chain_that_was_made_again_has_another_head(three: Store) -> None:
    head = three.verify().head
    change(three, "DELETE FROM chain WHERE run_id = 3")
    change(three, "DELETE FROM calibrations WHERE id = 3")
    found = three.verify()
    assert found.broken is None, "the end of a chain can be cut off"
    assert verify(three, found.head)[0] == 0
    code, output = verify(three, head)
    assert code == 1
    assert output == f"No run has the hash {head}: runs were removed, or the chain was made again.\n"


def test_retention_is_no_tampering(three: Store) -> None:
    assert three.drop_samples(datetime.now(UTC) + timedelta(days=1)) == 3
    assert three.verify().broken is None
    change(three, "UPDATE readings SET scale_mm = 0 WHERE calibration_id = 3")
    assert three.verify().broken is not None


def with_wire(store: Store) -> int:
    run = store.create(asked("R1", "rapid"), Robot.default("R1"))
    for piece in (b"first ", b"second"):
        store.add_wire(run, piece)
    store.finish(run, State.ABORTED)
    return run


def test_a_changed_wire_log_is_noticed_and_a_dropped_one_is_no_tampering(three: Store) -> None:
    run = with_wire(three)
    assert three.verify().broken is None
    assert three.drop_wire(datetime.now(UTC) + timedelta(days=1)) == 1
    assert three.verify().broken is None
    with pytest.raises(NotFound, match=f"No wire log of run {run}"):
        three.wire_log(run)
    changed = with_wire(three)
    change(three, f"UPDATE wire_logs SET piece = x'00' WHERE run_id = {changed} AND n = 2")
    broken = three.verify().broken
    assert broken is not None
    assert (broken.id, broken.why) == (changed, "its wire log is not as it was recorded")


def test_a_record_can_be_made_by_another_program(store: Store) -> None:
    run = run_of(store, State.ABORTED)
    row = store.summary(run)
    created = round(row.created_at.timestamp() * 1000)
    with closing(sqlite3.connect(store.path)) as other:
        (file,) = other.execute("SELECT file FROM robots").fetchone()
        ended, started = other.execute("SELECT ended_ms, started_ms FROM calibrations").fetchone()
        (expected,) = other.execute("SELECT hash FROM chain").fetchone()
    reading = {
        "reading": 1, "walk": 1, "t_s": 1.25, "theta1_deg": 0.5, "theta2_deg": 179.9, "approach1": 1,
        "approach2": -1, "scale_mm": 12.3456, "position": "p1", "temperature_c": None, "payload_kg": None,
        "mount": None,
    }  # fmt: skip
    record = {
        "version": 1, "uid": row.uid, "id": run, "robot_serial": "R1", "kind": "calibrate", "plan": "rapid",
        "operator": "ada", "work_order": None, "metadata": None, "of_id": None, "state": "aborted",
        "verdict": None, "outcome": "aborted", "reason": None, "reason_code": None, "reason_params": None,
        "step": 1, "steps": 0, "created_ms": created, "started_ms": started, "ended_ms": ended,
        "robot_sha256": hashlib.sha256(file.encode()).hexdigest(), "readings": [reading],
        "samples_sha256": hashlib.sha256(b'["[-10,10]"]').hexdigest(), "result": None,
        "diagnosis_sha256": None,
    }  # fmt: skip
    assert hashlib.sha256(rfc8785.dumps(record)).hexdigest() == expected


def test_runs_of_before_the_chain_are_not_covered_and_said_to_be(tmp_path: Path) -> None:
    released = Path(__file__).parent / "released" / "station-0.2.0.sqlite"
    shutil.copy(released, tmp_path / "station.db")
    with closing(Store(tmp_path / "station.db")) as store:
        found = store.verify()
        assert (found.runs, found.older, found.broken) == (0, 6, None)
        run_of(store)
        code, output = verify(store)
        assert code == 0
        assert output.startswith(
            "6 runs are older than the chain and not covered.\n1 runs are as they ended."
        )
