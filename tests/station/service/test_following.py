"""Runs that are about an earlier one, and what is seen of a run from outside."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace

import pytest

from station.errors import InputRefused, NotFound, StoreUnavailable
from station.five_bar.robot_file import Robot
from station.motion.events import LiveEvent
from station.records import (
    CalibrationSummary,
    MeasurementSequence,
    PlanName,
    Procedure,
    RunBrief,
    SequenceView,
    SetZeros,
    State,
)
from station.run_kinds import RUN_KINDS, RunKind
from station.service.orchestrator import Orchestrator
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import SETTINGS, Start
from tests.station.fakes import STOPS, Rig, result_of, two_sequences

LIMIT_S = 10.0
ROBOT = replace(Robot.default("R7"), workspace_x=(-200.0, 210.0))
done: dict[int, int] = {}


def already(store: Store, of: int) -> int | None:
    assert store.summary(of).id == of
    return done.get(of)


@pytest.fixture
def following(store: Store, rig: Rig) -> Iterator[Orchestrator]:
    """With a kind of run that is done once for each earlier run."""
    again = RunKind("again", lambda start: two_sequences("paper", start.robot), done_by=already)
    orchestrator = Orchestrator(rig.devices, store, SETTINGS, {**RUN_KINDS, "again": again})
    yield orchestrator
    rig.released.set()
    orchestrator.shutdown()


def test_a_run_about_an_earlier_one_is_of_its_robot(following: Orchestrator, store: Store) -> None:
    store.save_robot(ROBOT)
    earlier = store.create(asked("R7", "rapid"), ROBOT)
    started = following.follow("again", earlier, "bob", idempotency_key="k")
    assert started.created
    assert following.wait(started.id, LIMIT_S) is State.SUCCEEDED
    row = store.summary(started.id)
    assert (row.robot_serial, row.kind, row.operator, row.of) == ("R7", "again", "bob", earlier)
    repeated = following.follow("again", earlier, "bob", idempotency_key="k")
    assert (repeated.id, repeated.created) == (started.id, False)
    with pytest.raises(NotFound):
        following.follow("again", 99, "bob")


def test_what_was_done_already_is_answered_and_not_done_again(
    following: Orchestrator, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    earlier = store.create(asked("R7", "rapid"), ROBOT)
    monkeypatch.setitem(done, earlier, 41)
    found = following.follow("again", earlier, "bob")
    assert (found.id, found.created) == (41, False)
    assert [run.id for run in store.calibrations().items] == [earlier]


def test_what_is_not_carried_out_on_the_rig_is_refused(following: Orchestrator, store: Store) -> None:
    with pytest.raises(InputRefused, match=r"^Import is not carried out on the rig\.$"):
        following.submit(asked("R7", "import"))
    assert store.calibrations().items == []


def test_zeros_that_are_set_are_a_step_that_is_seen(start: Start, store: Store) -> None:
    answers: list[tuple[float, float]] = []

    def nothing_to_move(plan: PlanName, robot: Robot) -> Procedure:
        answers.append((yield SetZeros("Writing the zero offsets", 2, 1, (0.0, 0.0))))
        readings = yield MeasurementSequence("Verifying", 3, STOPS)
        return result_of(readings)

    events: list[LiveEvent] = []
    orchestrator = start(nothing_to_move)
    orchestrator.subscribe(events.append)
    run = orchestrator.submit(asked("R1", "paper")).id
    assert orchestrator.wait(run, LIMIT_S) is State.SUCCEEDED
    assert answers == [(0.0, 0.0)]
    sequences = [event.data for event in events if event.type == "walk"]
    assert [(s.number, s.title, len(s.stops)) for s in sequences if isinstance(s, SequenceView)] == [
        (2, "Writing the zero offsets", 0),
        (3, "Verifying", 3),
    ]
    briefs = [event.data for event in events if event.type == "run"]
    assert (2, "Writing the zero offsets") in [
        (b.walk.number, b.walk.title) for b in briefs if isinstance(b, RunBrief) and b.walk
    ]
    row = store.summary(run)
    assert (row.step, row.steps) == (3, 3)


def test_a_run_is_seen_with_its_own_robot_and_identity(start: Start, store: Store, rig: Rig) -> None:
    store.save_robot(ROBOT)
    rig.axes[0].stuck = True
    orchestrator = start()
    before = orchestrator.snapshot()
    assert before.station.emulated and before.station.name == SETTINGS.name
    assert before.workspace.x == Robot.default().workspace_x
    run = orchestrator.submit(asked("R7", "paper", work_order="WO-7")).id
    assert orchestrator.wait(run, 0.05) is State.RUNNING, "not longer than it was asked to"
    seen = orchestrator.snapshot()
    row = store.summary(run)
    assert seen.workspace.x == (-200.0, 210.0)
    assert seen.run is not None
    assert (seen.run.id, seen.run.uid, seen.run.robot_serial) == (run, row.uid, "R7")
    assert (seen.run.kind, seen.run.plan, seen.run.work_order) == ("calibrate", "paper", "WO-7")
    orchestrator.abort(run)
    assert orchestrator.wait(run, LIMIT_S) is State.ABORTED
    assert store.summary(run).reason == "Stopped by the operator."


def test_a_run_that_cannot_be_read_back_is_shown_from_memory(
    start: Start, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    ended: list[CalibrationSummary] = []

    def listen(event: LiveEvent) -> None:
        if isinstance(event.data, CalibrationSummary):
            ended.append(event.data)

    def unreadable(*_: object) -> None:
        raise StoreUnavailable("station.db: disk I/O error")

    def cut_off(plan: PlanName, robot: Robot) -> Procedure:
        yield MeasurementSequence("Measuring", 1, STOPS)
        monkeypatch.setattr(store, "summary", unreadable)
        orchestrator.stop("ada")
        return result_of([])

    orchestrator = start(cut_off)
    orchestrator.subscribe(listen)
    run = orchestrator.submit(asked("R1", "paper", work_order="WO-7"))
    with pytest.raises(StoreUnavailable):
        orchestrator.wait(run.id, LIMIT_S)
    monkeypatch.undo()
    shown, row = ended[0], store.summary(run.id)
    same = ("id", "uid", "robot_serial", "kind", "plan", "of", "operator", "work_order", "state", "verdict")
    assert [getattr(shown, name) for name in same] == [getattr(row, name) for name in same]
    assert (shown.step, shown.steps) == (row.step, row.steps) == (3, 3)
    assert (shown.outcome, shown.reason_code) == (None, "store_failed")
    assert shown.reason_params == {"text": "station.db: disk I/O error"}
    assert shown.reason is not None and "disk I/O error" in shown.reason
    assert abs((shown.created_at - row.created_at).total_seconds()) < 5.0


def test_a_new_station_shows_the_last_run_of_the_rig(start: Start, store: Store) -> None:
    run = store.create(asked("R1", "paper"), Robot.default("R1"))
    store.finish(run, State.ABORTED)
    last = start().snapshot().last
    assert last == store.summary(run)
    with closing(Store(store.path)) as other:
        assert other.last_on_rig() == last
