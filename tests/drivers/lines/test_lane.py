"""Who may use a line next: stops first, everybody else in the order in which they came."""

from __future__ import annotations

import threading

from drivers.lines.lane import Lane


def test_who_waits_goes_before_who_comes_again() -> None:
    """A watchdog's feeder is not passed again and again by whoever works with the line."""
    lane, order = Lane(), list[str]()
    waiting = threading.Event()

    def feeder() -> None:
        waiting.set()
        with lane.hold(urgent=False):
            order.append("feeder")

    thread = threading.Thread(target=feeder)
    with lane.hold(urgent=False):
        thread.start()
        waiting.wait()
        while not lane._queue:  # until it stands in line
            pass
    with lane.hold(urgent=False):
        order.append("worker again")
    thread.join()
    assert order == ["feeder", "worker again"]


def test_a_stop_passes_all_that_wait() -> None:
    lane, order = Lane(), list[str]()

    def hold(name: str, urgent: bool) -> None:
        with lane.hold(urgent=urgent):
            order.append(name)

    ordinary = threading.Thread(target=hold, args=("ordinary", False))
    stop = threading.Thread(target=hold, args=("stop", True))
    with lane.hold(urgent=False):
        ordinary.start()
        while not lane._queue:
            pass
        stop.start()
        while not lane.urgent_waiting:
            pass
    ordinary.join()
    stop.join()
    assert order == ["stop", "ordinary"]
