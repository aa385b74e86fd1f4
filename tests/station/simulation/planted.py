"""Mistakes that somebody could make in the production code, and the jobs and troubles that reveal them.

`python -m tests.station.simulation.planted` plants one after the other and prints how many simulated days it
took to notice each, and which rule was violated.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from station.motion import Machine
from station.motion.zero_writer import Zeroing
from station.records import Reading, State
from station.service import Orchestrator
from station.simulation import INVARIANTS, Life, live
from station.simulation.days import DEEDS, TROUBLES
from station.store import Store
from station.store.audit import AuditTrail
from station.store.ends import UnstoredEnds
from station.store.times import RunTimes

Patch = pytest.MonkeyPatch
MOST_DAYS = 60


@dataclass(frozen=True)
class Planted:
    """One mistake."""

    name: str
    plant: Callable[[Patch], None]
    deeds: Mapping[str, float] = field(default_factory=lambda: DEEDS)
    troubles: Mapping[str, float] = field(default_factory=lambda: TROUBLES)
    """More frequent disturbances, so that it is found sooner."""

    def found(self, seed: int) -> Life:
        """The life in which it is found, or `MOST_DAYS` without a finding."""
        with pytest.MonkeyPatch.context() as patch:
            self.plant(patch)
            return live(seed, MOST_DAYS, deeds=self.deeds, troubles=self.troubles)


def _nothing(*_: Any, **__: Any) -> None:
    return None


def _replace(owner: type, name: str, make: Callable[[Any], Any]) -> Callable[[Patch], None]:
    """Replace a method by a function made from it."""
    return lambda patch: patch.setattr(owner, name, make(getattr(owner, name)))


def _kept_rounded(add: Callable[..., None]) -> Callable[..., None]:
    def add_reading(store: Store, run: int, reading: Reading, *, wire: bytes = b"") -> None:
        add(store, run, replace(reading, scale_mm=round(reading.scale_mm, 3)), wire=wire)

    return add_reading


def _kept_ten_at_a_time(add: Callable[..., None]) -> Callable[..., None]:
    waiting: dict[int, list[Reading]] = {}

    def add_reading(store: Store, run: int, reading: Reading, *, wire: bytes = b"") -> None:
        waiting.setdefault(run, []).append(reading)
        if len(waiting[run]) == 10:
            for one in waiting.pop(run):
                add(store, run, one)

    return add_reading


def _known_until_restart(_: Callable[..., int | None]) -> Callable[..., int | None]:
    def find_key(store: Store, key: str, body_hash: bytes) -> int | None:
        known: dict[str, int] = store.__dict__.setdefault("known", {})
        return known.get(key)

    return find_key


def _without_a_holder(submit: Callable[..., Any]) -> Callable[..., Any]:
    def submit_anyway(station: Any, *args: Any, **kwargs: Any) -> Any:
        station._run = None
        return submit(station, *args, **kwargs)

    return submit_anyway


def _one_after_the_other(_: Callable[..., Any]) -> Callable[..., Any]:
    def quick_stop(machine: Machine) -> dict[str, str | None]:
        outcome: dict[str, str | None] = {}
        for axis in machine.devices.axes:
            try:
                axis.quick_stop()
                outcome[axis.name] = None
            except Exception as error:  # noqa: BLE001 - as the real one does
                outcome[axis.name] = str(error)
        return outcome

    return quick_stop


def _told_first(_: Callable[..., None]) -> Callable[..., None]:
    def write(zeroing: Any, number: int, offset_deg: float) -> None:
        joint, axis = zeroing.positioner.joints[number - 1], zeroing.machine.devices.axes[number - 1]
        before = zeroing._feedback(number)
        axis.preset(joint.zero_at_deg)
        after = zeroing._feedback(number)
        row = zeroing.store.begin_zero_write(zeroing.run_id, number, offset_deg, before)
        zeroing.store.end_zero_write(row, after)

    return write


def _always_taken(_: Callable[..., None]) -> Callable[..., None]:
    def settle(zeroing: Any) -> None:
        for write in zeroing._writes():
            if write.taken is None:
                zeroing.store.end_zero_write(write.id, zeroing.positioner.joints[write.joint - 1].zero_at_deg)

    return settle


def _newest_first(_: Callable[..., Any]) -> Callable[..., Any]:
    def next_delivery(store: Store, receiver: str) -> Any:
        waiting = store.deliveries(state="waiting", limit=1)
        if not waiting:
            return None
        (event,) = store.happenings(after=waiting[0].event - 1, limit=1)
        return waiting[0], event

    return next_delivery


def _changed_afterwards(finish: Callable[..., State]) -> Callable[..., State]:
    def finish_and_change(store: Store, run: int, *args: Any, **kwargs: Any) -> State:
        state = finish(store, run, *args, **kwargs)
        with store._writing() as db:
            db.execute("UPDATE calibrations SET operator = 'nobody' WHERE id = ?", [run])
        return state

    return finish_and_change


def _by_the_wall_clock(_: Callable[..., int]) -> Callable[..., int]:
    from station.store import times

    return lambda _times, _run: times.now_ms()


def _not_caught(_: Callable[..., None]) -> Callable[..., None]:
    def repeat(ends: Any, store: Callable[..., Any]) -> None:
        for run in ends.runs:
            store(run, ends._ends.pop(run))

    return repeat


def _recorded_twice(record: Callable[..., None]) -> Callable[..., None]:
    def twice(trail: AuditTrail, *args: Any, **kwargs: Any) -> None:
        record(trail, *args, **kwargs)
        record(trail, *args, **kwargs)

    return twice


def _gives_up(_: Callable[..., None]) -> Callable[..., None]:
    return lambda store, delivery, until, detail: store.settle(delivery, "delivered", detail)


def _says_stopped(machine: Machine) -> dict[str, str | None]:
    return {axis.name: None for axis in machine.devices.axes}


def _never_outside(retract: Callable[..., Any]) -> Callable[..., Any]:
    return lambda machine: retract(machine).model_copy(update={"needed": False})


def _plant_no_jump(patch: Patch) -> None:
    from station.identification import verification
    from station.run_kinds import verified

    for module in (verification, verified):
        if hasattr(module, "prediction_fault"):
            patch.setattr(module, "prediction_fault", _nothing)


KILLS = {"kill": 1.0, "kill at a write": 2.0, "none": 1.0}
BAD_DISK = {"disk": 2.0, "disk, then kill": 2.0, "none": 1.0}
ZEROS = {"apply": 5.0, "rollback": 2.0, "measure": 3.0}
STOPS = {"stop": 1.0, "stop while a drive is silent": 2.0, "abort": 2.0}

PLANTED = (
    Planted("a reading is not stored", _replace(Store, "add_reading", lambda _: _nothing)),
    Planted("readings are stored ten at a time", _replace(Store, "add_reading", _kept_ten_at_a_time)),
    Planted("readings are stored rounded", _replace(Store, "add_reading", _kept_rounded)),
    Planted("an idempotency key is forgotten", _replace(Store, "find_key", _known_until_restart)),
    Planted(
        "a second run is admitted",
        _replace(Orchestrator, "submit", _without_a_holder),
        troubles={"second start": 1.0},
    ),
    Planted(
        "a stop commands one axis after the other",
        _replace(Machine, "quick_stop", _one_after_the_other),
        troubles=STOPS,
    ),
    Planted(
        "a stop is confirmed without asking the drives",
        _replace(Machine, "quick_stop", lambda _: _says_stopped),
        troubles=STOPS,
    ),
    Planted("the devices are not made safe", _replace(Machine, "make_safe", lambda _: _nothing)),
    Planted("abort does nothing", _replace(Orchestrator, "abort", lambda _: _nothing), troubles=STOPS),
    Planted(
        "the journal is written after the drive",
        _replace(Zeroing, "_write", _told_first),
        deeds=ZEROS,
        troubles=KILLS,
    ),
    Planted(
        "an uncertain zero counts as accepted",
        _replace(Zeroing, "settle", _always_taken),
        deeds=ZEROS,
        troubles=KILLS,
    ),
    Planted(
        "an interrupted run remains active",
        _replace(Store, "interrupt_unfinished", lambda _: lambda store: []),
        troubles=KILLS,
    ),
    Planted(
        "storing the end of a run is not repeated",
        _replace(Store, "repeat_ends", lambda _: _nothing),
        troubles=BAD_DISK,
    ),
    Planted(
        "the end of a run is lost in a kill",
        _replace(UnstoredEnds, "_write", lambda _: _nothing),
        troubles=BAD_DISK,
    ),
    Planted("a failed delivery counts as done", _replace(Store, "postpone", _gives_up)),
    Planted("the newest event is delivered first", _replace(Store, "next_delivery", _newest_first)),
    Planted("a run is changed after its end", _replace(Store, "finish", _changed_afterwards)),
    Planted("starts are not in the audit", _replace(AuditTrail, "record", lambda _: _nothing)),
    Planted("starts are in the audit twice", _replace(AuditTrail, "record", _recorded_twice)),
    Planted(
        "the times of a run follow the wall clock",
        _replace(RunTimes, "now_ms", _by_the_wall_clock),
        troubles={"clock": 1.0},
    ),
    Planted("the fresh readings are ignored", _plant_no_jump, troubles={"device": 1.0}),
    Planted("an arm outside its workspace is not noticed", _replace(Machine, "retract", _never_outside)),
    Planted(
        "the worker ends if the disk fails twice",
        _replace(UnstoredEnds, "repeat", _not_caught),
        troubles=BAD_DISK,
    ),
)


def main() -> None:
    """Plant all."""
    for number, planted in enumerate(PLANTED, start=1):
        began_s = time.monotonic()
        life = planted.found(number)
        took_s = time.monotonic() - began_s
        names = ", ".join(dict.fromkeys(INVARIANTS[v.invariant] for v in life.violations))
        said = names or "NOT FOUND"
        print(
            f"{number:2} {planted.name}: day {life.days}, {life.runs} runs, {took_s:.0f} s: {said}",
            flush=True,
        )


if __name__ == "__main__":
    main()
