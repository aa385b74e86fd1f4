"""Times and identities of runs while the clock jumps."""

from __future__ import annotations

import time
import uuid
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.five_bar.robot_file import Robot
from station.records import State, uid7
from station.service.clock_watch import ClockWatch
from station.store.store import Store
from tests.station.asking import asked

ROBOT = Robot.default("R1")
T0 = datetime(2026, 9, 21, 14, 0, tzinfo=UTC)
HOUR_MS = 3_600_000
TEN_YEARS_MS = 10 * 365 * 24 * HOUR_MS


class Clocks:
    """The clock that people set, and monotonic time."""

    def __init__(self) -> None:
        self.wall_ms = round(T0.timestamp() * 1000)
        self.monotonic_ms = 77_000

    def passes(self, ms: int) -> None:
        self.wall_ms += ms
        self.monotonic_ms += ms

    def jumps(self, ms: int) -> None:
        self.wall_ms += ms

    def install(self, patch: pytest.MonkeyPatch) -> None:
        patch.setattr("station.store.times.now_ms", lambda: self.wall_ms)
        patch.setattr("station.store.store.now_ms", lambda: self.wall_ms)
        patch.setattr("station.store.times.monotonic_ms", lambda: self.monotonic_ms)
        patch.setattr("station.service.clock_watch.time.time", lambda: self.wall_ms / 1000)
        patch.setattr("station.service.clock_watch.time.monotonic", lambda: self.monotonic_ms / 1000)


@pytest.fixture
def clocks() -> Iterator[Clocks]:
    clocks = Clocks()
    with pytest.MonkeyPatch.context() as patch:
        clocks.install(patch)
        yield clocks


def run_of(store: Store, clocks: Clocks, *jumps_ms: int) -> int:
    """A run of three minutes in which the clock jumps."""
    run = store.create(asked("R1", "rapid"), ROBOT)
    clocks.passes(1_000)
    store.set_state(run, State.RUNNING)
    for jump in jumps_ms:
        clocks.jumps(jump)
    clocks.passes(180_000)
    store.finish(run, State.ABORTED)
    return run


@pytest.mark.parametrize("jump_ms", [-HOUR_MS, TEN_YEARS_MS])
def test_a_jump_during_a_run_changes_none_of_its_times(store: Store, clocks: Clocks, jump_ms: int) -> None:
    row = store.summary(run_of(store, clocks, jump_ms))
    assert row.created_at == T0
    assert row.started_at == T0 + timedelta(seconds=1)
    assert row.ended_at == T0 + timedelta(seconds=181)


def test_a_clock_of_2036_spoils_no_later_date(store: Store, clocks: Clocks) -> None:
    clocks.jumps(TEN_YEARS_MS)
    wrong = run_of(store, clocks)
    clocks.jumps(-TEN_YEARS_MS)
    right = run_of(store, clocks)
    assert store.summary(wrong).created_at.year == 2036
    assert store.summary(right).created_at == T0 + timedelta(seconds=181)
    assert [item.id for item in store.calibrations().items] == [right, wrong], "order is by number"


def test_a_run_that_another_process_began_ends_no_earlier_than_it_started(
    tmp_path: Path, clocks: Clocks
) -> None:
    path = tmp_path / "station.db"
    with closing(Store(path)) as store:
        run = store.create(asked("R1", "rapid"), ROBOT)
        clocks.passes(5_000)
        store.set_state(run, State.RUNNING)
    clocks.jumps(-HOUR_MS)
    with closing(Store(path)) as store:
        assert store.interrupt_unfinished() == [run]
        row = store.summary(run)
        assert row.ended_at == row.started_at == T0 + timedelta(seconds=5)


@settings(max_examples=25, deadline=None)
@given(
    jumps=st.lists(st.sampled_from([0, 0, -HOUR_MS, HOUR_MS, TEN_YEARS_MS, -TEN_YEARS_MS, 7]), max_size=12),
    since_s=st.integers(-7_200, 7_200),
    until_s=st.integers(-7_200, 7_200),
)
def test_filters_by_time_are_right_after_any_jump(
    tmp_path_factory: pytest.TempPathFactory, jumps: list[int], since_s: int, until_s: int
) -> None:
    clocks = Clocks()
    with (
        pytest.MonkeyPatch.context() as patch,
        closing(Store(tmp_path_factory.mktemp("times") / "station.db")) as store,
    ):
        clocks.install(patch)
        for jump in jumps:
            run_of(store, clocks, jump)
        since, until = T0 + timedelta(seconds=since_s), T0 + timedelta(seconds=until_s)
        every = store.calibrations().items
        for query, wanted in (
            ({"since": since}, [r.id for r in every if r.created_at >= since]),
            ({"until": until}, [r.id for r in every if r.created_at < until]),
            ({"since": since, "until": until}, [r.id for r in every if since <= r.created_at < until]),
        ):
            assert [r.id for r in store.calibrations(**query).items] == wanted  # type: ignore[arg-type]
        for row in every:
            assert row.started_at is not None and row.ended_at is not None
            assert row.created_at <= row.started_at <= row.ended_at


# Identity ----------------------------------------------------------------------------------------


def test_a_uid_is_of_version_7_and_says_when() -> None:
    uid = uuid.UUID(uid7(0x0199_7A6E_8E80))
    assert (uid.version, uid.variant) == (7, uuid.RFC_4122)
    assert uid.int >> 80 == 0x0199_7A6E_8E80
    assert abs((uuid.UUID(uid7()).int >> 80) - time.time() * 1000) < 60_000
    assert len({uid7(1) for _ in range(1000)}) == 1000


def test_every_run_has_its_uid_and_a_restored_number_has_another(tmp_path: Path, clocks: Clocks) -> None:
    path, backup = tmp_path / "station.db", tmp_path / "backup.db"
    with closing(Store(path)) as store:
        first = store.summary(store.create(asked("R1", "rapid"), ROBOT))
        store.backup(backup)
        second = store.summary(store.create(asked("R1", "rapid"), ROBOT))
        assert uuid.UUID(first.uid).int >> 80 == clocks.wall_ms
        assert first.uid != second.uid
    with closing(Store(backup)) as store:
        again = store.summary(store.create(asked("R2", "rapid"), Robot.default("R2")))
        assert store.summary(first.id).uid == first.uid
    assert again.id == second.id
    assert again.uid != second.uid


# The watch ---------------------------------------------------------------------------------------


def jumps_on_record(store: Store) -> list[tuple[str, object]]:
    return [(event.kind, event.data["by_s"]) for event in store.events(None)]


def test_jumps_are_events_and_drift_is_none(store: Store, clocks: Clocks) -> None:
    watch = ClockWatch(store)
    for _ in range(10):
        clocks.passes(500)
        clocks.jumps(1_500)  # a clock that is pulled to the right time
        watch.look()
    assert jumps_on_record(store) == []
    clocks.jumps(-HOUR_MS)
    watch.look()
    watch.look()
    clocks.jumps(TEN_YEARS_MS)
    watch.look()
    assert jumps_on_record(store) == [("clock_jump", -3600.0), ("clock_jump", 315_360_000.0)]


def test_a_clock_that_is_behind_the_last_record_is_noticed_at_the_start(store: Store, clocks: Clocks) -> None:
    ClockWatch(store)
    run_of(store, clocks)
    clocks.passes(HOUR_MS)
    ClockWatch(store)
    assert jumps_on_record(store) == []
    clocks.jumps(-2 * HOUR_MS)
    ClockWatch(store)
    assert jumps_on_record(store) == [("clock_behind", -3600.0)]


def test_a_jump_that_the_store_does_not_take_is_recorded_later(
    store: Store, clocks: Clocks, monkeypatch: pytest.MonkeyPatch
) -> None:
    watch = ClockWatch(store)
    clocks.jumps(HOUR_MS)
    store._writer.execute("PRAGMA query_only = ON")
    watch.look()
    store._writer.execute("PRAGMA query_only = OFF")
    watch.look()
    assert jumps_on_record(store) == [("clock_jump", 3600.0)]
