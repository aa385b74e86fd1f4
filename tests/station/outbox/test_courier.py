"""In order, at least once, over restarts; refusals and old events do not hold up the rest."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest

from station.outbox import Courier, Refused
from station.records import Event
from station.settings import OutboxSettings
from station.store.store import Store

ALL = ("run.started", "run.ended", "alarm", "station.started", "station.stopped")


class Taker:
    """A receiver on order: what `answers` holds next is raised, then it takes everything."""

    name = "taker"

    def __init__(self, *answers: BaseException, events: tuple[str, ...] = ALL) -> None:
        self.answers, self.events = list(answers), events
        self.seen: list[int] = []
        self.uids: list[str] = []

    def report_running(self) -> None: ...

    def deliver(self, event: Event) -> str:
        self.seen.append(event.n)
        self.uids.append(event.uid)
        if self.answers:
            raise self.answers.pop(0)
        return "ok"

    def close(self) -> None: ...


class Clock:
    """The station's clock, moved by hand."""

    def __init__(self) -> None:
        self.now = datetime.now(UTC) + timedelta(seconds=5)

    def __call__(self) -> datetime:
        return self.now

    def wait(self, seconds: float) -> None:
        self.now += timedelta(seconds=seconds)


@pytest.fixture
def clock() -> Clock:
    return Clock()


def courier(store: Store, taker: Taker, clock: Clock, settings: OutboxSettings | None = None) -> Courier:
    store.enqueue(taker.name, taker.events)
    return Courier(store, taker, settings or OutboxSettings(), clock)


def tell(store: Store, *texts: str) -> None:
    for text in texts:
        store.announce("alarm", {"text": text})


def states(store: Store) -> dict[int, str]:
    return {d.event: d.state for d in store.deliveries()}


def test_numbers_rise_from_one_and_pages_follow_them(store: Store) -> None:
    tell(store, "a", "b", "c")
    assert [e.n for e in store.happenings()] == [1, 2, 3]
    assert [e.data["text"] for e in store.happenings(after=1, limit=1)] == ["b"]


def test_a_day_of_failures_loses_nothing_and_changes_no_order(store: Store, clock: Clock) -> None:
    taker = Taker(*(OSError("answered 500 Internal Server Error") for _ in range(32)))
    on_the_way = courier(store, taker, clock)
    tell(store, "a", "b")
    waits = []
    while taker.answers:
        assert on_the_way.step() == 0.0
        (waiting,) = (d for d in store.deliveries() if d.event == 1)
        assert waiting.next_at is not None and "500" in waiting.detail
        waits.append(round((waiting.next_at - clock.now).total_seconds()))
        clock.wait(waits[-1] - 0.1)
        assert 0 < on_the_way.step() <= 0.5, "not before its time"
        clock.wait(3600.0)
    assert waits == [1, 2, 4, 8, 16, 32, *[60] * 26]
    assert set(taker.seen) == {1}, "nothing overtakes the one that waits"
    on_the_way.step(), on_the_way.step()
    assert taker.seen[-2:] == [1, 2] and len(set(taker.uids)) == 2
    assert states(store) == {1: "delivered", 2: "delivered"}


def test_a_clock_that_is_set_back_holds_nothing_up(store: Store, clock: Clock) -> None:
    taker = Taker(OSError("answered 500 Internal Server Error"))
    on_the_way = courier(store, taker, clock)
    tell(store, "a")
    on_the_way.step()
    clock.wait(-3600.0)
    on_the_way.step()
    assert states(store) == {1: "delivered"}


def test_another_process_goes_on_where_the_last_one_was(store: Store, clock: Clock) -> None:
    """Killed in the middle of an answer: the event comes again, with the same id."""
    first = Taker(KeyboardInterrupt())
    on_the_way = courier(store, first, clock)
    tell(store, "a", "b")
    with pytest.raises(KeyboardInterrupt):
        on_the_way.step()
    second = Taker()
    again = Courier(store, second, OutboxSettings(), clock)
    again.step(), again.step()
    assert second.seen == [1, 2] and second.uids[0] == first.uids[0]


def test_what_is_refused_for_good_is_shown_and_does_not_block(store: Store, clock: Clock) -> None:
    taker = Taker(Refused("410 Gone"))
    on_the_way = courier(store, taker, clock)
    tell(store, "a", "b")
    on_the_way.step(), on_the_way.step()
    assert states(store) == {1: "refused", 2: "delivered"}
    (refused,) = store.deliveries(state="refused")
    assert refused.detail == "410 Gone" and refused.next_at is None
    store.resend(refused.id)
    on_the_way.step()
    assert taker.seen == [1, 2, 1] and taker.uids[0] == taker.uids[2]
    assert states(store) == {1: "delivered", 2: "delivered"}


def test_a_receiver_hears_what_it_asked_for_from_its_first_day_on(store: Store, clock: Clock) -> None:
    tell(store, "before it was there")
    taker = Taker(events=("station.stopped",))
    on_the_way = courier(store, taker, clock)
    tell(store, "not asked for")
    store.announce("station.stopped", {})
    on_the_way.step()
    assert taker.seen == [3]


def test_what_is_too_old_or_too_much_is_given_up_and_said(store: Store, clock: Clock) -> None:
    taker = Taker()
    on_the_way = courier(store, taker, clock, OutboxSettings(keep_days=1, keep=2))
    tell(store, "a", "b", "c")
    on_the_way.step()
    assert states(store) == {1: "expired", 2: "waiting", 3: "waiting"}
    clock.wait(2 * 86400)
    with store._writing() as db:
        db.execute("UPDATE deliveries SET tries = 1440 WHERE state = 'waiting' AND n = 2")
    on_the_way.step()
    assert set(states(store).values()) == {"expired"}
    assert "given up" in store.deliveries()[0].detail and not taker.seen


def test_a_clock_that_is_set_forward_gives_nothing_up(store: Store, clock: Clock) -> None:
    on_the_way = courier(store, Taker(OSError("answered 500")), clock, OutboxSettings(keep_days=1))
    tell(store, "a", "b")
    on_the_way.step()
    clock.wait(10 * 365 * 86400)
    on_the_way.step(), on_the_way.step()
    assert states(store) == {1: "delivered", 2: "delivered"}


def test_the_end_of_a_run_and_its_event_are_one_transaction(store: Store) -> None:
    from station.five_bar.robot_file import Robot
    from station.records import State
    from tests.station.asking import asked, result

    run = store.create(asked("R1", "rapid", work_order="WO-7"), Robot.default("R1"))
    store.finish(run, State.SUCCEEDED, result())
    started, ended = store.happenings()
    assert (started.type, ended.type) == ("run.started", "run.ended")
    summary = store.summary(run)
    told = {key: ended.data[key] for key in ("uid", "id", "state", "verdict", "outcome", "work_order")}
    assert told == {
        "uid": summary.uid, "id": run, "state": "succeeded", "verdict": summary.verdict,
        "outcome": summary.outcome, "work_order": "WO-7",
    }  # fmt: skip
