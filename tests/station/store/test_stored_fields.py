"""Every column that the store writes and every field that it gives back, compared one by one."""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import pytest

from station.errors import InputRefused, KeyReused, NotFound, StoreUnavailable
from station.five_bar.robot_file import Robot
from station.records import (
    Accuracy,
    Actor,
    LastingParameters,
    Quantity,
    Reading,
    State,
    because,
)
from station.store import compact, request_hash
from station.store.ends import unsound
from station.store.rows import millis, moment, row_id
from station.store.store import Store
from tests.station.asking import asked, result

ROBOT = Robot.default("R1")
T0_MS = 1_790_000_000_000
T0 = datetime(2026, 9, 21, 14, 13, 20, tzinfo=UTC)
LASTING = LastingParameters(names=("L1",), mean=(375.01,), covariance=((0.0004,),))
RESULT = result(
    zero_offsets=(
        Quantity("dtheta1", 1.23456789, 0.0312345678, "deg"),
        Quantity("dtheta2", -0.7, 0.04, "deg"),
    ),
    parameters=(Quantity("dr_Mx", 1.0, 0.1, "mm"),),
    after={"reading_rms_mm": 0.01},
    lasting=LASTING,
)


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The station's clock, ms."""
    now = [T0_MS]
    monkeypatch.setattr("station.store.times.time.time_ns", lambda: now[0] * 1_000_000)
    monkeypatch.setattr("station.store.times.monotonic_ms", lambda: now[0] - T0_MS)
    return now


@pytest.fixture
def store(tmp_path: Path, clock: list[int]) -> Iterator[Store]:
    store = Store(tmp_path / "station.db")
    yield store
    store.close()


def rows(store: Store, table: str) -> list[dict[str, Any]]:
    """As any other program sees them."""
    with closing(sqlite3.connect(store.path)) as other:
        other.row_factory = sqlite3.Row
        return [dict(row) for row in other.execute(f"SELECT * FROM {table}")]


def test_every_column_of_a_run_from_its_creation_to_its_end(store: Store, clock: list[int]) -> None:
    first = store.create(asked("R1", "rapid"), ROBOT)
    clock[0] = T0_MS + 1000
    run = store.create(
        asked("R1", "apply", work_order="WO-7", metadata={"shift": "späť"}, of=first), ROBOT, key="k"
    )
    created = rows(store, "calibrations")[1]
    uid = created.pop("uid")
    assert created == {
        "id": run, "robot_id": 1, "robot_serial": "R1", "robot_type": None, "kind": "apply",
        "plan": "apply", "operator": "ada",
        "work_order": "WO-7", "metadata": '{"shift":"späť"}', "of_id": first, "state": "queued",
        "verdict": None, "outcome": None, "reason": None, "reason_code": None, "reason_params": None,
        "step": 0, "steps": 0, "created_ms": T0_MS + 1000, "started_ms": None, "ended_ms": None,
    }  # fmt: skip
    assert rows(store, "calibrations")[0]["metadata"] is None
    clock[0] = T0_MS + 2000
    store.set_state(run, State.RUNNING, steps=12)
    store.set_state(run, State.RUNNING)
    running = {"state": "running", "steps": 12, "started_ms": T0_MS + 2000}
    created["uid"] = uid
    assert rows(store, "calibrations")[1] == {**created, **running}
    clock[0] = T0_MS + 3000
    assert store.finish(run, State.SUCCEEDED, RESULT, because("stopped", by="bob")) is State.SUCCEEDED
    ended = {
        "state": "succeeded", "verdict": "pass", "outcome": "good", "reason": "Stopped by bob.",
        "reason_code": "stopped", "reason_params": '{"by":"bob"}', "ended_ms": T0_MS + 3000,
    }  # fmt: skip
    assert rows(store, "calibrations")[1] == {**created, **running, **ended}
    (kept,) = rows(store, "results")
    assert (kept["calibration_id"], kept["diagnosis"]) == (run, None)
    assert (kept["zero1_deg"], kept["zero1_sd_deg"]) == (1.23456789, 0.0312345678)
    assert (kept["zero2_deg"], kept["zero2_sd_deg"]) == (-0.7, 0.04)
    assert json.loads(kept["result"]) == {
        "zero_offsets": [
            {"joint": 1, "value_deg": 1.23457, "sd_deg": 0.0312346},
            {"joint": 2, "value_deg": -0.7, "sd_deg": 0.04},
        ],
        "method": "published",
        "parameters": [{"name": "dr_Mx", "value": 1.0, "sd": 0.1, "unit": "mm"}],
        "after": {"reading_rms_mm": 0.01},
    }
    assert rows(store, "memories") == [
        {
            "calibration_id": run, "robot_serial": "R1", "at_ms": T0_MS + 3000,
            "memory": LASTING.model_dump_json(), "cleared_ms": None, "cleared_by": None,
        }
    ]  # fmt: skip
    summary = store.summary(run)
    assert (summary.created_at, summary.started_at, summary.ended_at) == tuple(
        T0 + timedelta(seconds=s) for s in (1, 2, 3)
    )
    assert (summary.of, summary.work_order, summary.operator, summary.kind) == (first, "WO-7", "ada", "apply")
    assert (summary.reason, summary.reason_code, summary.reason_params) == (
        "Stopped by bob.",
        "stopped",
        {"by": "bob"},
    )
    whole = store.calibration(run)
    assert whole.metadata == {"shift": "späť"}
    assert whole.parameters == RESULT.parameters
    assert whole.method == "published"
    assert store.runs_of(first) == [summary]


@pytest.mark.parametrize(
    ("state", "given", "expected"),
    [
        (State.ABORTED, None, ("aborted", None, "aborted", None)),
        (State.FAILED, None, ("failed", None, "failed", None)),
        (State.INTERRUPTED, None, ("interrupted", None, "interrupted", None)),
        (State.SUCCEEDED, None, ("failed", None, "failed", "no_result")),
        (State.ABORTED, RESULT, ("aborted", None, "aborted", "converged")),
        (State.SUCCEEDED, RESULT, ("succeeded", "pass", "good", "converged")),
    ],
)
def test_state_verdict_and_outcome_of_every_end(
    store: Store, state: State, given: Any, expected: tuple[str | None, ...]
) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT)
    assert store.finish(run, state, given).value == expected[0]
    row = store.summary(run)
    assert (row.state.value, row.verdict, row.outcome, row.reason_code) == expected
    assert (store.memory("R1") is not None) == (expected[1] == "pass")
    if expected[3] is None:
        assert (row.reason, row.reason_params) == (None, {})


def test_of_a_result_with_nan_the_method_stays_and_no_number(store: Store) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT)
    bad = RESULT.model_copy(update={"after": Accuracy(reading_rms_mm=float("inf"))})
    assert store.finish(run, State.SUCCEEDED, bad) is State.FAILED
    whole = store.calibration(run)
    assert (whole.state, whole.verdict, whole.outcome) == ("failed", "fail", "failed")
    assert (whole.reason_code, whole.reason_params) == ("not_a_number_at", {"where": "after.reading_rms_mm"})
    assert (whole.method, whole.zero_offsets, whole.after) == ("published", (), None)
    assert store.memory("R1") is None


@pytest.mark.parametrize(
    ("value", "where"),
    [
        ({"a": 1.0, "b": ["x", 2]}, None),
        ({"a": [0.0, {"b": float("nan")}]}, "a[1].b"),
        ([float("-inf")], "[0]"),
        (Accuracy(fresh_reading_rms_mm=float("inf")), "fresh_reading_rms_mm"),
        ("nan", None),
        (float("nan"), ""),
    ],
)
def test_where_the_first_number_stands_that_is_not_finite(value: object, where: str | None) -> None:
    assert unsound(value) == where


def test_every_column_of_a_reading(store: Store) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT)
    full = Reading(
        3, 1.23456, (0.5018, 179.9982), (1, -1), 12.345678, "p1", 2, (12.3456, 12.3457), 21.5, 1.25, "B"
    )
    bare = Reading(4, 2.0, (0.0, 180.0), (0, 0), 12.0, "p2")
    store.add_readings(run, [full, bare])
    first, second = rows(store, "readings")
    assert first == {
        "calibration_id": run, "reading": 3, "walk": 2, "t_s": 1.235, "theta1_deg": 0.5018,
        "theta2_deg": 179.9982, "approach1": 1, "approach2": -1, "scale_mm": 12.345678, "position": "p1",
        "samples": "[-8,2]", "temperature_c": 21.5, "payload_kg": 1.25, "mount": "B",
    }  # fmt: skip
    assert second["samples"] is None
    assert store.readings(run) == [replace(full, t_s=1.235), bare]
    assert store.summary(run).step == 2


@pytest.mark.parametrize("field", ["t_s", "theta_deg", "scale_mm", "samples_mm"])
def test_no_number_of_a_reading_may_be_infinite(store: Store, field: str) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT)
    bad: Any = (1.0, float("inf")) if field.endswith(("deg", "samples_mm")) else float("inf")
    reading = replace(Reading(5, 1.0, (0.0, 180.0), (0, 0), 12.0, "p1"), **{field: bad})
    with pytest.raises(ValueError, match=r"^reading 5 has a number that is not finite$"):
        store.add_reading(run, reading)
    assert store.summary(run).step == 0


def test_every_column_of_an_event(store: Store, clock: list[int]) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT)
    clock[0] = T0_MS + 5000
    store.add_event(run, "stop", {"by": "ada"})
    store.add_event(None, "start")
    assert rows(store, "events") == [
        {"id": 1, "calibration_id": run, "at_ms": T0_MS + 5000, "kind": "stop", "data": '{"by":"ada"}'},
        {"id": 2, "calibration_id": None, "at_ms": T0_MS + 5000, "kind": "start", "data": None},
    ]
    (stop,) = store.events(run)
    assert (stop.id, stop.at, stop.kind, stop.data) == (1, T0 + timedelta(seconds=5), "stop", {"by": "ada"})
    assert store.events(None)[0].data == {}


def test_every_column_of_a_zero_that_is_written(store: Store, clock: list[int]) -> None:
    of = store.create(asked("R1", "rapid"), ROBOT)
    other = store.create(asked("R2", "apply", of=of), Robot.default("R2"))
    store.begin_zero_write(other, 1, 9.0, 9.0)
    run = store.create(asked("R1", "apply", of=of), ROBOT)
    clock[0] = T0_MS + 5000
    first = store.begin_zero_write(run, 2, 0.5, 179.5)
    second = store.begin_zero_write(run, 1, -0.25, 0.25)
    store.end_zero_write(first, 180.0)
    store.end_zero_write(second, None)
    third = store.begin_zero_write(run, 1, -0.25, 0.25)
    assert [row["at_ms"] for row in rows(store, "zero_writes")[1:]] == [T0_MS + 5000] * 3
    writes = store.zero_writes("R1")
    assert [(w.id, w.run_id, w.of, w.joint) for w in writes] == [
        (first, run, of, 2),
        (second, run, of, 1),
        (third, run, of, 1),
    ]
    assert [(w.offset_deg, w.from_deg, w.to_deg, w.taken) for w in writes] == [
        (0.5, 179.5, 180.0, True),
        (-0.25, 0.25, None, False),
        (-0.25, 0.25, None, None),
    ]
    assert [w.shift_deg for w in writes] == [-0.5, 0.0, None]
    assert store.zero_writes("R1", since=run) == []
    assert len(store.zero_writes("R1", since=run - 1)) == 3


# Robots and memories -----------------------------------------------------------------------------


def test_robots_with_their_newest_file_and_its_time(store: Store, clock: list[int]) -> None:
    clock[0] = T0_MS + 1000
    first = store.save_robot(ROBOT)
    assert store.save_robot(ROBOT) == first
    clock[0] = T0_MS + 2000
    changed = replace(ROBOT, drm=(0.9, 0.4))
    second = store.save_robot(changed)
    store.save_robot(Robot.default("A0"))
    assert (first, second) == (1, 2)
    kept = store.robots()
    assert [robot.serial for robot in kept] == ["A0", "R1"]
    assert kept[1].saved_at == T0 + timedelta(seconds=2)
    assert kept[1].file == json.loads(compact(changed.to_json()))
    assert store.save_robot(ROBOT) == 4, "back to an earlier file is a version of its own"
    assert store.robot_or_nominal("R9") == Robot.default("R9")
    with pytest.raises(NotFound, match=r"^Robot R9 is not known here\.$"):
        store.robot("R9")


def passed(store: Store, lasting: LastingParameters | None = LASTING, serial: str = "R1") -> int:
    run = store.create(asked(serial, "rapid"), store.robot_or_nominal(serial))
    store.finish(run, State.SUCCEEDED, RESULT.model_copy(update={"lasting": lasting}))
    return run


def test_the_newest_memory_counts_with_its_time_and_numbers(store: Store, clock: list[int]) -> None:
    assert store.memory("R1") is None
    passed(store)
    clock[0] = T0_MS + 60_000
    newer = LASTING.model_copy(update={"mean": (375.02,)})
    run = passed(store, newer)
    passed(store, LASTING, "R2")
    known = store.memory("R1")
    assert known is not None
    ended = store.summary(run).ended_at
    assert (known.calibration_id, known.memory, known.at) == (run, newer, ended)
    assert known.at.tzinfo is UTC
    assert store.memory_left_by(run) == known


def test_a_pass_that_leaves_nothing_leaves_the_older_memory(store: Store) -> None:
    run = passed(store)
    later = passed(store, None)
    known = store.memory("R1")
    assert known is not None and known.calibration_id == run
    with pytest.raises(NotFound, match=rf"^Run {later} left no memory\.$"):
        store.memory_left_by(later)


def test_a_cleared_memory_is_not_used_and_stays_on_record(store: Store, clock: list[int]) -> None:
    first, second = passed(store), passed(store)
    passed(store, LASTING, "R2")
    clock[0] = T0_MS + 60_000
    store.forget("R1", Actor(name="ada", via="open"))
    store.forget("R1", Actor(name="bob", via="open"))
    assert store.memory("R1") is None, "nor the one before it"
    assert store.memory("R2") is not None
    assert store.memory_left_by(first).memory == LASTING
    cleared = [(row["cleared_ms"], row["cleared_by"]) for row in rows(store, "memories")]
    assert cleared == [(T0_MS + 60_000, "ada")] * 2 + [(None, None)]
    third = passed(store)
    known = store.memory("R1")
    assert known is not None and known.calibration_id == third != second
    with pytest.raises(NotFound, match="R9"):
        store.forget("R9", Actor(name="ada", via="open"))


def test_a_memory_under_another_robot_file_is_not_used(store: Store) -> None:
    passed(store)
    store.save_robot(replace(ROBOT, drm=(0.9, 0.4)))
    assert store.memory("R1") is None
    passed(store)
    assert store.memory("R1") is not None


# Asking ------------------------------------------------------------------------------------------


def test_fifty_runs_a_page_unless_asked_otherwise(store: Store) -> None:
    for _ in range(51):
        store.create(asked("R1", "rapid"), ROBOT)
    page = store.calibrations()
    assert ([page.items[0].id, page.items[-1].id], page.next) == ([51, 2], 2)
    last = store.calibrations(cursor=page.next)
    assert ([item.id for item in last.items], last.next) == ([1], None)
    assert store.calibrations(limit=51).next is None


def test_cursors_at_the_ends_of_the_range(store: Store) -> None:
    store.create(asked("R1", "rapid"), ROBOT)
    assert store.calibrations(cursor="1").items == []
    assert len(store.calibrations(cursor=str(2**63 - 1)).items) == 1
    assert row_id("1") == 1
    for cursor in ("0", str(2**63)):
        with pytest.raises(InputRefused, match=f"^The cursor '{cursor}' is not one that a page gave.$"):
            store.calibrations(cursor=cursor)


def test_the_newest_run_of_the_rig_is_no_import(store: Store) -> None:
    assert store.last_on_rig() is None
    run = store.create(asked("R1", "rapid"), ROBOT)
    store.create(asked("R1", "import"), ROBOT)
    last = store.last_on_rig()
    assert last is not None and last.id == run


def test_a_time_without_a_zone_is_utc_wherever_the_station_stands(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TZ", "Asia/Tokyo")
    time.tzset()
    try:
        assert millis(T0.replace(tzinfo=None)) == T0_MS
        assert millis(T0.astimezone(timezone(timedelta(hours=-5)))) == T0_MS
        assert moment(T0_MS) == T0
        assert str(moment(T0_MS)).endswith("+00:00")
        assert moment(None) is None
    finally:
        monkeypatch.undo()
        time.tzset()


def test_a_reused_key_names_the_run_that_it_started(store: Store) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT, key="k", body_hash=b"a")
    with pytest.raises(KeyReused) as reused:
        store.find_key("k", b"b")
    assert reused.value.calibration_id == run
    with pytest.raises(KeyReused) as reused:
        store.create(asked("R1", "rapid"), ROBOT, key="k", body_hash=b"a")
    assert reused.value.calibration_id == run
    assert len(rows(store, "calibrations")) == 1, "refused whole"


@pytest.mark.parametrize(
    "other",
    [
        asked("R2", "rapid"),
        asked("R1", "full"),
        asked("R1", "rapid", "bob"),
        asked("R1", "rapid", work_order="w"),
        asked("R1", "rapid", metadata={"a": 1}),
        asked("R1", "rapid", of=1),
    ],
)
def test_every_field_of_a_request_makes_it_another_one(other: Any) -> None:
    assert request_hash(asked("R1", "rapid")) == request_hash(asked("R1", "rapid"))
    assert request_hash(other) != request_hash(asked("R1", "rapid"))
    assert len(request_hash(other)) == 16


def test_keys_of_older_stations_still_belong_to_their_requests() -> None:
    request = asked("R1", "rapid", work_order="WO-7", metadata={"shift": "late"})
    assert request_hash(request).hex() == "1876df41078167d51640104f8eddc3a6"


def test_an_import_is_stored_whole_or_not_at_all(store: Store) -> None:
    readings = [Reading(k, float(k), (0.0, 180.0), (0, 0), 12.0, "p") for k in (1, 2)]
    run = store.add_run(asked("R1", "import"), ROBOT, readings, RESULT, key="k", body_hash=b"h")
    whole = store.calibration(run)
    assert (whole.state, whole.verdict, whole.step, whole.steps) == ("succeeded", "pass", 2, 2)
    assert store.readings(run) == readings
    assert store.find_key("k", b"h") == run
    with pytest.raises(sqlite3.IntegrityError):
        store.add_run(asked("R1", "import"), ROBOT, [readings[0], readings[0]], RESULT, key="other")
    assert store.find_key("other", b"") is None
    assert [item.id for item in store.calibrations().items] == [run]


def test_an_interrupted_run_says_so(store: Store) -> None:
    run = store.create(asked("R1", "rapid"), ROBOT)
    store.interrupt_unfinished()
    row = store.summary(run)
    assert (row.outcome, row.reason_code) == ("interrupted", "interrupted")
    assert row.reason


def test_a_diagnosis_that_is_not_there(store: Store) -> None:
    run = passed(store)
    with pytest.raises(NotFound, match=rf"^Run {run} has no diagnosis\.$"):
        store.diagnosis(run)
    for ask in (store.diagnosis, store.summary, store.calibration, store.robot_of, store.readings):
        with pytest.raises(NotFound, match=r"^There is no calibration 99\.$"):
            ask(99)


# The file ----------------------------------------------------------------------------------------


def test_a_backup_is_a_station_database_and_overwrites_nothing(store: Store, tmp_path: Path) -> None:
    run = passed(store)
    copy = tmp_path / "copy.db"
    store.backup(copy)
    with pytest.raises(InputRefused, match=rf"^{copy} exists already; a backup never overwrites\.$"):
        store.backup(copy)
    with closing(Store(copy)) as other:
        assert other.calibration(run) == store.calibration(run)
    nowhere = tmp_path / "no" / "copy.db"
    with pytest.raises(InputRefused, match=rf"^The backup {nowhere} cannot be written: unable to open"):
        store.backup(nowhere)


def test_a_closed_store_takes_and_gives_nothing(store: Store) -> None:
    run = passed(store)
    store.close()
    store.close()
    with pytest.raises(sqlite3.ProgrammingError):
        store.add_event(run, "late")


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    path = tmp_path / "file" / "station.db"
    with pytest.raises(InputRefused, match=f"^The database {path} cannot be opened: "):
        Store(path)
    (tmp_path / "folder.db").mkdir()
    with pytest.raises(InputRefused, match=r"folder\.db cannot be used: it is not a file"):
        Store(tmp_path / "folder.db")


def test_a_missing_folder_is_made(tmp_path: Path) -> None:
    with closing(Store(tmp_path / "a" / "b" / "station.db")) as store:
        assert store.calibrations().items == []
        assert store.path.exists()


def test_readers_cannot_write_and_wait_for_a_lock(store: Store) -> None:
    with pytest.raises(StoreUnavailable, match="readonly"):
        store._readers.all("DELETE FROM events")
    row = store._readers.one("PRAGMA busy_timeout")
    assert row is not None and row[0] == 5000
    assert store._writer.execute("PRAGMA busy_timeout").fetchone()[0] == 5000
