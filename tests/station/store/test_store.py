"""Every reading on disk, fail-closed verdicts, pages, keys, foreign files."""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from station.errors import InputRefused, KeyReused, NotFound
from station.five_bar.robot_file import Robot
from station.records import (
    Accuracy,
    CalibrationRequest,
    PositionError,
    Quantity,
    Reading,
    Residual,
    State,
    because,
)
from station.store.store import Store
from tests.station.asking import asked, result

REQUEST = asked("R1", "paper", work_order="WO-7", metadata={"shift": "late"})
READING = Reading(1, 1.25, (0.5018, 179.9982), (1, -1), 12.34567, "p1", 1, (12.3456, 12.3457))
SAMPLES = (109.9894, 109.9890, 109.9870, 109.9880, 109.9890)
RESULT = result(
    zero_offsets=(Quantity("dtheta1", 1.2, 0.03, "deg"), Quantity("dtheta2", -0.7, 0.04, "deg")),
    parameters=(Quantity("dr_Mx", 1.0, 0.1, "mm"),),
    weak_direction={"singular_ratio": 475.3, "text": "both arms together", "sd_deg": 0.1},
    before={"reading_rms_mm": 3.0},
    after={"reading_rms_mm": 0.01},
    iterations=[{"pass": 1, "mu_deg": 0.5}],
    residuals=[{"reading": 1, "position": "p1", "residual_mm": 0.001, "limit_mm": 0.01}],
)
STOPPED = because("stopped", by="ada")


def start(store: Store, request: CalibrationRequest = REQUEST, **key: object) -> int:
    return store.create(request, Robot.default(request.robot_serial), **key)  # type: ignore[arg-type]


def test_a_run_comes_back_as_it_was_stored(store: Store) -> None:
    run = start(store)
    store.set_state(run, State.RUNNING, steps=6)
    store.add_reading(run, READING)
    assert store.readings(run) == [READING]
    assert store.finish(run, State.SUCCEEDED, RESULT) is State.SUCCEEDED
    calibration = store.calibration(run)
    assert [zero.model_dump() for zero in calibration.zero_offsets] == [
        {"joint": 1, "value_deg": 1.2, "sd_deg": 0.03},
        {"joint": 2, "value_deg": -0.7, "sd_deg": 0.04},
    ]
    assert (calibration.state, calibration.verdict, calibration.step, calibration.steps) == (
        "succeeded",
        "pass",
        1,
        6,
    )
    assert calibration.metadata == {"shift": "late"}
    assert calibration.residuals[0].position == "p1"
    assert calibration.findings == ()
    assert store.robot_of(run).to_json() == Robot.default("R1").to_json()
    assert calibration.created_at.tzinfo is UTC


def test_a_reading_is_on_the_disk_when_the_call_returns(store: Store) -> None:
    run = start(store)
    store.add_reading(run, READING)
    with sqlite3.connect(store.path) as other:
        assert other.execute("SELECT count(*) FROM readings").fetchone() == (1,)
        assert other.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    other.close()
    assert store._writer.execute("PRAGMA synchronous").fetchone() == (2,)


@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
def test_a_pass_with_a_number_that_is_not_finite_becomes_a_failure(store: Store, bad: float) -> None:
    run = start(store)
    result = RESULT.model_copy(
        update={"after": Accuracy(predicted_position_error_mm=PositionError(rms=0.1, max=bad))}
    )
    assert store.finish(run, State.SUCCEEDED, result) is State.FAILED
    calibration = store.calibration(run)
    assert calibration.verdict == "fail"
    assert "after.predicted_position_error_mm.max" in (calibration.reason or "")


def test_success_without_a_result_and_a_result_without_success_are_no_pass(store: Store) -> None:
    first, second = start(store), start(store)
    assert store.finish(first, State.SUCCEEDED) is State.FAILED
    store.finish(second, State.ABORTED, RESULT, STOPPED)
    assert store.calibration(first).verdict is None
    assert store.calibration(second).verdict is None


def test_the_first_end_stands(store: Store) -> None:
    run = start(store)
    store.finish(run, State.ABORTED, reason=STOPPED)
    assert store.finish(run, State.SUCCEEDED, RESULT) is State.ABORTED
    store.set_state(run, State.RUNNING)
    calibration = store.calibration(run)
    assert (calibration.state, calibration.verdict) == ("aborted", None)


def test_a_reading_that_is_not_a_number_is_not_stored(store: Store) -> None:
    run = start(store)
    with pytest.raises(ValueError, match="reading 1"):
        store.add_reading(run, replace(READING, scale_mm=float("nan")))
    assert store.readings(run) == []


def test_what_a_power_cut_leaves_behind_is_interrupted(store: Store) -> None:
    queued, running, done = start(store), start(store), start(store)
    store.set_state(running, State.RUNNING)
    store.finish(done, State.SUCCEEDED, RESULT)
    assert store.interrupt_unfinished() == [queued, running]
    assert store.calibration(queued).state == "interrupted"
    assert store.calibration(done).state == "succeeded"
    assert store.interrupt_unfinished() == []


def test_a_key_is_one_run_and_another_body_is_refused(store: Store) -> None:
    run = start(store, key="k1", body_hash=b"a")
    assert store.find_key("k1", b"a") == run
    assert store.find_key("k2", b"a") is None
    with pytest.raises(KeyReused):
        store.find_key("k1", b"b")
    with pytest.raises(KeyReused):
        start(store, key="k1", body_hash=b"a")
    assert len(store.calibrations().items) == 1


def test_pages_meet_without_gap_or_overlap_under_every_filter(store: Store) -> None:
    for n in range(25):
        run = start(store, replace(REQUEST, robot_serial=f"R{n % 2}"))
        if n % 5 == 0:
            store.finish(run, State.SUCCEEDED, RESULT)
    for query, count in (
        ({}, 25),
        ({"robot_serial": "R1"}, 12),
        ({"verdict": "pass"}, 5),
        ({"state": "queued"}, 20),
    ):
        ids: list[int] = []
        cursor = None
        while True:
            page = store.calibrations(limit=4, cursor=cursor, **query)  # type: ignore[arg-type]
            ids += [item.id for item in page.items]
            cursor = page.next
            if cursor is None:
                break
        assert ids == sorted(set(ids), reverse=True)
        assert len(ids) == count
    assert not hasattr(page.items[0], "residuals")


def test_a_period_of_time_selects_by_creation(store: Store) -> None:
    run = start(store)
    created = store.calibration(run).created_at
    later = created + timedelta(milliseconds=1)
    assert [item.id for item in store.calibrations(since=created, until=later).items] == [run]
    assert store.calibrations(since=later).items == []
    assert store.calibrations(until=created).items == []
    assert store.calibrations(until=datetime(1999, 1, 1)).items == []


@pytest.mark.parametrize("cursor", ["x", "-1", str(2**70)])
def test_a_cursor_that_no_page_gave_is_refused(store: Store, cursor: str) -> None:
    with pytest.raises(InputRefused, match="cursor"):
        store.calibrations(cursor=cursor)


def test_events_of_a_run_and_of_the_station(store: Store) -> None:
    run = start(store)
    store.add_event(run, "abort", {"by": "ada"})
    store.add_event(None, "start")
    assert [(event.kind, event.data) for event in store.events(run)] == [("abort", {"by": "ada"})]
    assert [event.kind for event in store.events(None)] == ["start"]


def test_a_changed_robot_file_is_a_new_version_and_old_runs_keep_theirs(store: Store) -> None:
    run = start(store)
    changed = replace(Robot.default("R1"), drm=(0.9, 0.4))
    store.save_robot(changed)
    store.save_robot(changed)
    assert store.robot("R1").to_json() == changed.to_json()
    assert store.robot_of(run).to_json() == Robot.default("R1").to_json()
    assert [robot.serial for robot in store.robots()] == ["R1"]


def test_what_does_not_exist_is_said(store: Store) -> None:
    for ask in (store.calibration, store.readings, store.robot_of):
        with pytest.raises(NotFound, match="99"):
            ask(99)
    with pytest.raises(NotFound, match="R9"):
        store.robot("R9")


def refused(path: Path) -> str:
    """The refusal; the file is as it was, and nothing stands beside it."""
    before = path.read_bytes()
    with pytest.raises(InputRefused) as refusal:
        Store(path)
    assert path.read_bytes() == before
    assert [file.name for file in path.parent.iterdir()] == [path.name]
    text = str(refusal.value)
    assert text.startswith(f"The database {path} cannot be used: ")
    assert text.endswith("; restore it from a backup or move it away.")
    return text


def test_a_file_that_is_no_database_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "station.db"
    path.write_bytes(b"not a database at all" * 100)
    assert "file is not a database" in refused(path)


def test_an_empty_file_is_not_taken_for_a_new_history(tmp_path: Path) -> None:
    path = tmp_path / "station.db"
    path.touch()
    assert "it is empty" in refused(path)


@pytest.mark.parametrize("page", [1, 3, 6])
def test_a_database_with_a_page_of_zeros_is_refused(tmp_path: Path, page: int) -> None:
    path = tmp_path / "station.db"
    store = Store(path)
    start(store)
    store.close()
    with path.open("r+b") as file:
        file.seek((page - 1) * 4096)
        file.write(bytes(4096))
    assert re.search("damaged|not a database|malformed", refused(path))


def test_a_new_history_appears_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def cut_off(*_: object) -> None:
        raise KeyboardInterrupt

    path = tmp_path / "station.db"
    with monkeypatch.context() as patch:
        patch.setattr("station.store.opening.migrations.apply", cut_off)
        with pytest.raises(KeyboardInterrupt):
            Store(path)
    assert not path.exists()
    Store(path).close()
    assert [file.name for file in tmp_path.iterdir()] == ["station.db"]


def test_another_programs_database_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "other.db"
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE theirs (x)")
    connection.close()
    with pytest.raises(InputRefused, match="another program"):
        Store(path)


def test_a_database_of_a_newer_station_is_left_alone(tmp_path: Path) -> None:
    store = Store(tmp_path / "station.db")
    store._writer["_sqlite_migrations"].insert(  # type: ignore[union-attr]
        {"migration_set": "station", "name": "from_the_future", "applied_at": ""}
    )
    store.close()
    with pytest.raises(InputRefused, match="newer station"):
        Store(tmp_path / "station.db")


def test_opening_twice_migrates_once(tmp_path: Path) -> None:
    for _ in range(2):
        store = Store(tmp_path / "station.db")
        run = start(store)
        store.close()
    assert run == 2


def test_a_run_of_six_readings_takes_less_than_2500_bytes_and_500_to_say_who_and_whom(store: Store) -> None:
    told = ("audit", "happenings", "run_starters")

    def sizes() -> tuple[int, int]:
        """Bytes of the run itself, and of audit and events."""
        store._writer.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        rows = store._writer.execute("SELECT name IN (?, ?, ?), sum(pgsize) FROM dbstat GROUP BY 1", told)
        found = dict(rows.fetchall())
        return found[0], found[1]

    runs, empty = 100, sizes()
    for n in range(runs):
        run = start(store, key=f"3f2a7c9e-{n:08d}", body_hash=bytes(16))
        readings = [
            replace(READING, reading=k, position=f"P{k}", scale_mm=109.98848 + n, samples_mm=SAMPLES)
            for k in range(1, 7)
        ]
        store.add_readings(run, readings)
        rows = tuple(
            Residual(reading=k, position=f"P{k}", residual_mm=0.00032361 * k + n, limit_mm=0.0058 + n)
            for k in range(1, 7)
        )
        store.finish(run, State.SUCCEEDED, RESULT.model_copy(update={"residuals": rows}))
    own, aside = ((after - before) / runs for after, before in zip(sizes(), empty, strict=True))
    assert own < 2500 and aside < 500


@pytest.mark.parametrize(
    "query",
    [
        {},
        {"cursor": 10},
        {"robot_serial": "R1"},
        {"state": "failed"},
        {"verdict": "pass"},
        {"robot_serial": "R1", "state": "failed", "verdict": "fail"},
        {"work_order": "WO-7"},
        {"work_order": "WO-7", "robot_serial": "R1", "plan": "paper"},
        {"since": datetime(2026, 1, 1), "until": datetime(2026, 2, 1)},
        {"order": "serial", "cursor": 10},
        {"order": "serial_down", "search": "R", "state": "failed", "since": datetime(2026, 1, 1)},
    ],
)
def test_a_page_is_found_by_index_and_never_sorted(
    store: Store, query: dict[str, object], monkeypatch: pytest.MonkeyPatch
) -> None:
    ask = store._readers.all
    steps: list[str] = []

    def explain(sql: str, values: Sequence[object]) -> list[object]:
        steps.extend(row["detail"] for row in ask(f"EXPLAIN QUERY PLAN {sql}", values))
        return []

    monkeypatch.setattr(store._readers, "all", explain)
    store.calibrations(**query)  # type: ignore[arg-type]
    plan = " ".join(steps)
    assert "TEMP B-TREE" not in plan
    if query:
        assert "SEARCH calibrations" in plan
        assert "SCAN calibrations" not in plan
