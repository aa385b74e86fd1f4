"""A run that asks: it waits, it is answered, refused, expired, stopped; nothing that was typed in is lost."""

from __future__ import annotations

from typing import Any

import pytest

from station.errors import FieldRefused, NotApplicable, NotFound
from station.five_bar.robot_file import Robot
from station.records import Ask, MeasurementSequence, PlanName, Procedure, Prompt, State
from station.service.orchestrator import Orchestrator
from station.settings import LimitSettings, Settings
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import SETTINGS, Start
from tests.station.fakes import STOPS, Rig, result_of
from tests.waiting import soon

LIMIT_S = 10.0
HURRIED = Settings(limits=LimitSettings(settle_s=0.1, samples=2, prompt_s=0.2))


def asks(plan: PlanName, robot: Robot) -> Procedure:
    """A number, then something to be done."""
    readings = yield MeasurementSequence("Measuring", 1, STOPS)
    value = yield Ask("Reading the level", 1, "Read the level.", "number", "deg", low=-12.0, high=12.0)
    yield Ask("Moving", 1, f"Move it by {value:g}.", "confirm", mounted_at=(200.0, -79.0))
    readings += yield MeasurementSequence("Measuring again", 1, STOPS[:1], mount="second")
    return result_of(readings)


def prompt_of(orchestrator: Orchestrator, run: int) -> Prompt:
    return soon(lambda: orchestrator.prompt(run))


def test_it_waits_and_goes_on_with_the_answer(start: Start, store: Store, rig: Rig) -> None:
    orchestrator = start(asks)
    moved: list[Any] = []
    object.__setattr__(rig.devices, "remount", lambda c, mounting: moved.append(c))
    run = orchestrator.submit(asked("FB-1", "full")).id
    first = prompt_of(orchestrator, run)
    assert (first.text, first.kind, first.unit) == ("Read the level.", "number", "deg")
    assert orchestrator.wait(run, 0.05) is State.WAITING
    view = orchestrator.snapshot().run
    assert view is not None
    assert (view.state, view.prompt) == (State.WAITING, first)
    assert store.summary(run).state is State.WAITING
    orchestrator.answer(run, first.id, 1.25, "ada")
    second = prompt_of(orchestrator, run)
    assert (second.text, second.kind) == ("Move it by 1.25.", "confirm")
    orchestrator.answer(run, second.id, None, "bob")
    assert orchestrator.wait(run, LIMIT_S) is State.SUCCEEDED
    answers = [event.data for event in store.events(run) if event.kind == "answer"]
    assert [(a["value"], a["by"]) for a in answers] == [(1.25, "ada"), (None, "bob")]
    assert [reading.mount for reading in store.readings(run)] == [None, None, None, "second"]
    assert moved == [(0.0, -79.0), (200.0, -79.0)]


def test_what_cannot_be_is_refused_and_it_goes_on_waiting(start: Start) -> None:
    orchestrator = start(asks)
    with pytest.raises(NotFound):
        orchestrator.answer(99, "x", None, "ada")
    run = orchestrator.submit(asked("FB-1", "full")).id
    prompt = prompt_of(orchestrator, run)
    for value in (None, 12.5, float("nan")):
        with pytest.raises(FieldRefused):
            orchestrator.answer(run, prompt.id, value, "ada")
    with pytest.raises(NotApplicable):
        orchestrator.answer(run, "another", 1.0, "ada")
    assert orchestrator.prompt(run) == prompt
    orchestrator.abort(run)
    assert orchestrator.wait(run, LIMIT_S) is State.ABORTED
    with pytest.raises(NotApplicable):
        orchestrator.answer(run, prompt.id, 1.0, "ada")


def test_nobody_answers(start: Start, store: Store, rig: Rig) -> None:
    orchestrator = start(asks, HURRIED)
    run = orchestrator.submit(asked("FB-1", "full")).id
    assert orchestrator.wait(run, LIMIT_S) is State.ABORTED
    summary = store.summary(run)
    assert (summary.reason_code, summary.outcome, summary.verdict) == ("prompt_expired", "aborted", None)
    assert "Read the level." in (summary.reason or "")
    assert "axis 1 make_safe" in rig.script.calls
    assert len(store.readings(run)) == 3


def test_a_station_that_went_down_while_it_waited_marks_the_run(start: Start, store: Store) -> None:
    run = store.create(asked("FB-1", "full"), Robot.default("FB-1"))
    store.set_state(run, State.WAITING)
    assert store.interrupt_unfinished() == [run]
    assert store.summary(run).state is State.INTERRUPTED
    assert SETTINGS.limits.prompt_s == 300.0
