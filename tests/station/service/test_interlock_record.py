"""What an interlock said during a run, and what stopped it, are in the record of the run."""

from __future__ import annotations

from drivers.errors import DeviceFault, LinkLost
from station.motion import LiveEvent
from station.records import Interlock
from station.service.interlock_record import InterlockRecord
from station.store.store import Store
from tests.station.asking import asked
from tests.station.conftest import Start
from tests.station.fakes import Rig

LIMIT_S = 20.0


def event(ok: bool, detail: str = "") -> LiveEvent:
    return LiveEvent("interlock", (Interlock(id="scale", text="The scale reads", ok=ok, detail=detail),))


def test_changes_are_recorded_and_what_stays_is_not(store: Store) -> None:
    run: list[int | None] = [None]
    listener = InterlockRecord(store, lambda: run[0])
    listener(event(False, "no reading"))
    listener(event(True))  # nothing is under way
    run[0] = store.create(asked("R1", "rapid"), store.robot_or_nominal("R1"))
    for told in (event(True), event(False, "no reading"), event(False, "no reading"), event(True)):
        listener(told)
    assert [(e.kind, e.data["id"], e.data["ok"], e.data["detail"]) for e in store.events(run[0])] == [
        ("interlock", "scale", False, "no reading"),
        ("interlock", "scale", True, ""),
    ]


def test_what_stops_a_motion_is_in_the_record_with_the_time_to_standstill(
    start: Start, store: Store, rig: Rig
) -> None:
    rig.script.fail("scale read", DeviceFault("The scale cannot measure."), at=8)
    orchestrator = start()
    run = orchestrator.submit(asked("R1", "rapid")).id
    assert orchestrator.wait(run, LIMIT_S) == "failed"
    (trip,) = (e for e in store.events(run) if e.kind == "trip")
    assert "cannot measure" in str(trip.data["text"])
    assert float(str(trip.data["standstill_after_ms"])) >= 0.0


def test_a_run_that_never_moved_has_no_trip(start: Start, store: Store, rig: Rig) -> None:
    rig.script.fail("axis 1 connect", LinkLost("Axis 1: power?"))
    orchestrator = start()
    run = orchestrator.submit(asked("R1", "rapid")).id
    assert orchestrator.wait(run, LIMIT_S) == "failed"
    assert [e for e in store.events(run) if e.kind == "trip"] == []
