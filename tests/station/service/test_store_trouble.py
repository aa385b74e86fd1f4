"""A database that is full, locked or unreadable: what is shown, what is stored once it works again."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest

from drivers.errors import LinkLost
from station.errors import StoreUnavailable
from station.five_bar.robot_file import Robot
from station.motion.events import LiveEvent
from station.records import MeasurementSequence, PlanName, Procedure, State
from station.store.connections import Readers
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import Start
from tests.station.fakes import STOPS, Rig, result_of
from tests.waiting import soon

REQUEST = asked("R1", "paper")
LIMIT_S = 10.0


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.store.connections._BUSY_MS", 10)
    monkeypatch.setattr("station.service.orchestrator.IDLE_S", 0.01)


class Lock:
    """Another program that writes, for as long as it holds the lock."""

    def __init__(self, store: Store) -> None:
        self._other = sqlite3.connect(store.path, check_same_thread=False)

    def hold(self) -> None:
        self._other.execute("BEGIN IMMEDIATE")

    def release(self) -> None:
        self._other.rollback()

    def __enter__(self) -> None:
        self.hold()

    def __exit__(self, *_: object) -> None:
        self._other.close()


@pytest.fixture
def lock(store: Store) -> Iterator[Lock]:
    lock = Lock(store)
    yield lock
    lock.__exit__()


class Disk:
    """What the database stands on."""

    def __init__(self, store: Store) -> None:
        self._db = store._writer.conn

    def fill(self) -> None:
        """No room for one page more; what fits into pages that are there already is still taken."""
        self._db.execute(f"PRAGMA max_page_count = {self._db.execute('PRAGMA page_count').fetchone()[0]}")

    def space_back(self) -> None:
        self._db.execute("PRAGMA max_page_count = 1073741823")


def on_disk(store: Store, run: int) -> tuple[str, str | None, str | None]:
    with closing(sqlite3.connect(store.path)) as other:
        row = other.execute("SELECT state, verdict, reason_code FROM calibrations WHERE id = ?", [run])
        state, verdict, code = row.fetchone()
    return state, verdict, code


def then(what: Callable[[], None], verdict: str = "pass") -> Callable[[PlanName, Robot], Procedure]:
    """A run in which something happens between its last reading and its end."""

    def procedure(plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Measuring", 1, STOPS)
        what()
        return result_of(readings, verdict)

    return procedure


def test_an_end_that_is_not_taken_is_shown_as_a_failure_and_stored_later(
    start: Start, store: Store, lock: Lock
) -> None:
    ended: list[LiveEvent] = []
    orchestrator = start(then(lock.hold))
    orchestrator.subscribe(lambda event: ended.append(event) if event.type == "ended" else None)
    run = orchestrator.submit(REQUEST).id
    assert orchestrator.wait(run, LIMIT_S) is State.FAILED
    shown = store.summary(run)
    assert (shown.state, shown.verdict, shown.outcome) == ("failed", None, "failed")
    assert shown.reason == "The database does not take what was measured: station.db: database is locked."
    assert shown.ended_at is not None
    assert store.calibration(run).state == "failed"
    last = orchestrator.snapshot().last
    assert last == shown == ended[-1].data
    assert on_disk(store, run) == ("running", None, None)
    assert [item.id for item in store.calibrations(state="failed").items] == [run]
    assert store.calibrations(state="running").items == []
    assert store.calibrations(verdict="pass").items == []
    lock.release()
    soon(lambda: on_disk(store, run) == ("failed", None, "store_failed"))
    stored = store.summary(run)
    assert stored.model_copy(update={"zero_offsets": ()}) == shown
    # the numbers are kept, the readings were already
    assert store.calibration(run).method == "fake"
    assert len(store.readings(run)) == 3
    assert store.interrupt_unfinished() == []


def test_the_reason_that_a_run_failed_for_stays_its_reason(
    start: Start, store: Store, rig: Rig, lock: Lock
) -> None:

    def fault() -> None:
        rig.script.faults.clear()
        lock.hold()
        raise LinkLost("nothing answers")

    def moves() -> None:  # not before: an idle station looks at its scale too
        rig.script.faults.clear()
        rig.script.do("scale read", fault, at=rig.script.calls.count("scale read") + 1)

    rig.script.do("axis 1 move_to", moves)
    orchestrator = start()
    run = orchestrator.submit(REQUEST).id
    assert orchestrator.wait(run, LIMIT_S) is State.FAILED
    reason = store.summary(run).reason or ""
    assert reason.startswith("At position") and reason.endswith("nothing answers")
    lock.release()
    soon(lambda: on_disk(store, run)[0] == "failed")
    assert store.summary(run).reason == reason


def test_a_disk_that_fills_stops_the_run_with_what_it_has(start: Start, store: Store, rig: Rig) -> None:
    disk = Disk(store)
    rig.script.do("scale read", disk.fill, at=5)

    def long(plan: PlanName, robot: Robot) -> Procedure:
        for number in range(1, 200):
            readings = yield MeasurementSequence("Measuring", number, STOPS)
        return result_of(readings)

    orchestrator = start(long)
    run = orchestrator.submit(REQUEST).id
    assert orchestrator.wait(run, LIMIT_S) is State.FAILED
    shown = store.summary(run)
    assert (
        shown.reason == "The database does not take what was measured: station.db: database or disk is full."
    )
    assert {"axis 1 quick_stop", "axis 2 quick_stop"} <= set(rig.script.calls)
    kept = store.readings(run)
    assert [reading.reading for reading in kept] == list(range(1, len(kept) + 1))
    assert len(kept) >= 2
    disk.space_back()
    soon(lambda: on_disk(store, run)[0] == "failed")
    assert store.readings(run) == kept
    rig.script.faults.clear()
    again = orchestrator.submit(asked("R1", "rapid"))
    orchestrator.stop("ada")
    assert orchestrator.wait(again.id, LIMIT_S) is State.ABORTED


def test_while_the_store_takes_nothing_no_run_starts(start: Start, store: Store) -> None:
    orchestrator = start()
    with Lock(store), pytest.raises(StoreUnavailable, match=r"^station\.db: database is locked$"):
        orchestrator.submit(REQUEST, idempotency_key="k")
    assert orchestrator.snapshot().run is None
    assert store.calibrations().items == []
    run = orchestrator.submit(REQUEST, idempotency_key="k")
    assert run.created
    assert orchestrator.wait(run.id, LIMIT_S) is State.SUCCEEDED


def test_an_end_outlives_the_process_that_could_not_store_it(tmp_path: Path) -> None:
    path = tmp_path / "station.db"
    with closing(Store(path)) as store:
        failed, aborted, unknown = (store.create(REQUEST, Robot.default("R1")) for _ in range(3))
        with Lock(store):
            assert store.finish(failed, State.SUCCEEDED, result_of([])) is State.FAILED
            assert store.finish(aborted, State.ABORTED) is State.ABORTED
            assert store.finish(failed, State.ABORTED) is State.FAILED, "the first end stands"
    with closing(Store(path)) as store:
        assert store.interrupt_unfinished() == [failed, aborted, unknown]
        assert [on_disk(store, run)[0] for run in (failed, aborted, unknown)] == [
            "failed",
            "aborted",
            "interrupted",
        ]
        assert "database is locked" in (store.summary(failed).reason or "")
    assert not list(tmp_path.glob("*ends*"))


def test_a_note_of_ends_that_is_no_such_note_is_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "station.db"
    (tmp_path / "station.db-ends.json").write_text("{")
    with closing(Store(path)) as store:
        run = store.create(REQUEST, Robot.default("R1"))
        assert store.interrupt_unfinished() == [run]
        assert store.summary(run).state == "interrupted"


def test_a_store_that_cannot_even_be_read_leaves_the_snapshot_valid(
    start: Start, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    def unreadable(*_: object) -> None:
        raise StoreUnavailable("station.db: disk I/O error")

    orchestrator = start(then(lambda: monkeypatch.setattr(store, "summary", unreadable)))
    run = orchestrator.submit(REQUEST).id
    soon(lambda: orchestrator.snapshot().last is not None)
    last = orchestrator.snapshot().last
    assert last is not None
    assert (last.id, last.state, last.verdict) == (run, "succeeded", None)
    assert "disk I/O error" in (last.reason or "")
    monkeypatch.undo()


def test_a_transaction_that_read_first_is_not_refused_for_what_another_program_wrote(store: Store) -> None:
    run = store.create(REQUEST, Robot.default("R1"))
    with store._writing() as db:
        db.execute("SELECT count(*) FROM calibrations").fetchone()
        with (
            closing(sqlite3.connect(store.path, timeout=0)) as other,
            pytest.raises(sqlite3.OperationalError, match="locked"),
        ):
            other.execute("INSERT INTO events (at_ms, kind) VALUES (1, 'other')")
        store.add_event(run, "ours")
    assert [event.kind for event in store.events(run)] == ["ours"]


def test_what_fails_within_a_transaction_leaves_nothing_of_it(store: Store) -> None:
    with pytest.raises(ZeroDivisionError), store._writing():
        store.add_event(None, "first")
        raise ZeroDivisionError
    assert store.events(None) == []
    store.add_event(None, "second")
    assert [event.kind for event in store.events(None)] == ["second"]


def test_a_damaged_file_is_unavailable_not_a_mistake(store: Store) -> None:
    store.create(REQUEST, Robot.default("R1"))
    store._writer.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    with store.path.open("r+b") as file:
        file.seek(4096)
        file.write(bytes(store.path.stat().st_size - 4096))
    with pytest.raises(StoreUnavailable, match="malformed"):
        Readers(store.path).all("SELECT * FROM calibrations")
