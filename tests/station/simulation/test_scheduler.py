"""Threads in virtual time: one at a time, the same order for the same seed, ended at once by a kill."""

from __future__ import annotations

import queue
from random import Random

import pytest

from station.simulation.scheduler import Deadlock, Killed, Process, Scheduler
from station.simulation.threads import Threads


def _interleaved(seed: int) -> list[str]:
    scheduler = Scheduler(Random(seed))
    said: list[str] = []

    def speak(name: str) -> None:
        for number in range(5):
            said.append(f"{name}{number}")
            scheduler.give_way()

    tasks = [scheduler.spawn(lambda name=name: speak(name), name) for name in "abc"]  # type: ignore[misc]
    scheduler.wait(lambda: all(task.ended for task in tasks))
    return said


def test_the_seed_draws_the_order() -> None:
    assert _interleaved(1) == _interleaved(1)
    assert len({tuple(_interleaved(seed)) for seed in range(5)}) > 1
    assert sorted(_interleaved(1)) == sorted(f"{name}{number}" for name in "abc" for number in range(5))


def test_time_passes_only_where_everybody_waits() -> None:
    scheduler = Scheduler(Random(1))
    woken: list[tuple[str, float]] = []
    for name, seconds in (("late", 3600.0), ("soon", 0.5)):

        def sleep(name: str = name, seconds: float = seconds) -> None:
            scheduler.wait(seconds=seconds)
            woken.append((name, scheduler.now_s))

        scheduler.spawn(sleep, name)
    scheduler.wait(lambda: len(woken) == 2)
    assert woken == [("soon", 0.5), ("late", 3600.0)]


def test_a_killed_process_does_nothing_more_but_unwind() -> None:
    scheduler = Scheduler(Random(1))
    process = Process("station")
    unwound: list[str] = []

    def work() -> None:
        try:
            while True:
                scheduler.wait(seconds=1.0)
        except Exception:  # noqa: BLE001 - nothing that handles errors may handle a kill
            unwound.append("handled")
        finally:
            with pytest.raises(Killed):
                scheduler.wait(seconds=1.0)
            unwound.append("unwound")

    scheduler.spawn(work, "worker", process)
    scheduler.wait(seconds=10.0)
    scheduler.kill(process)
    assert unwound == ["unwound"]
    assert scheduler.tasks_of(process) == []


def test_who_waits_for_each_other_is_named() -> None:
    scheduler = Scheduler(Random(1))
    threads = Threads(scheduler)
    first, second = threads.Lock(), threads.Lock()

    def take(one: object, other: object) -> None:
        with one:  # type: ignore[attr-defined]
            scheduler.give_way()
            scheduler.wait(seconds=1.0)
            with other:  # type: ignore[attr-defined]
                pass

    scheduler.spawn(lambda: take(first, second), "left")
    scheduler.spawn(lambda: take(second, first), "right")
    with pytest.raises(Deadlock, match=r"left.*right"):
        scheduler.wait(lambda: False)
    scheduler.end()


def test_a_queue_and_an_event_end_their_waiting_in_virtual_time() -> None:
    scheduler = Scheduler(Random(1))
    threads = Threads(scheduler)
    letters, flag = threads.Queue(), threads.Event()
    with pytest.raises(queue.Empty):
        letters.get(timeout=5.0)
    assert not flag.wait(2.0)
    assert scheduler.now_s == 7.0
    scheduler.spawn(lambda: letters.put("a"), "writer")
    assert letters.get() == "a"
    scheduler.end()
