"""Samples that are dropped by rule: what stays, and that it is said."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from datetime import UTC, datetime, timedelta

from station.five_bar.robot_file import Robot
from station.records import Reading, State, from_readings
from station.service.retention import retention_timer
from station.settings import RetentionSettings
from station.store.store import Store
from tests.station.asking import asked
from tests.waiting import soon

READING = Reading(1, 1.25, (0.5, 179.9), (1, -1), 12.3456, "p1", 1, (12.3455, 12.3456, 12.3457))


def run_of(store: Store, ended: bool = True) -> int:
    run = store.create(asked("R1", "rapid"), Robot.default("R1"))
    store.add_reading(run, READING)
    if ended:
        store.finish(run, State.ABORTED)
    return run


def made_older(store: Store, run: int, days: float) -> None:
    with closing(sqlite3.connect(store.path)) as other, other:
        other.execute(
            "UPDATE calibrations SET ended_ms = ended_ms - ? WHERE id = ?", [round(days * 86_400_000), run]
        )


def test_mean_and_number_stay_and_the_run_says_so(store: Store) -> None:
    old, new, under_way = run_of(store), run_of(store), run_of(store, ended=False)
    before = store.readings(old)
    made_older(store, old, 400)
    assert store.drop_samples(datetime.now(UTC) - timedelta(days=365)) == 1
    assert store.drop_samples(datetime.now(UTC) - timedelta(days=365)) == 0, "once"
    (kept,) = store.readings(old)
    assert (kept.scale_mm, kept.samples_mm) == (READING.scale_mm, (READING.scale_mm,) * 3)
    # nothing that is computed from the reading changes
    for name in ("distance", "theta", "samples", "t_s"):
        assert (getattr(from_readings([kept]), name) == getattr(from_readings(before), name)).all()
    assert [event.kind for event in store.events(old)] == ["samples_dropped"]
    for run in (new, under_way):
        assert store.readings(run) == [READING]
        assert store.events(run) == []


def test_the_rule_of_the_station_file_is_applied_at_the_start(store: Store) -> None:
    run = run_of(store)
    made_older(store, run, 8)
    with retention_timer(store, RetentionSettings()):
        pass
    assert store.readings(run) == [READING]
    with retention_timer(store, RetentionSettings(samples_days=7.0)):
        soon(lambda: store.events(run))
    assert store.readings(run) != [READING]
