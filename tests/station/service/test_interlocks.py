"""Guard door and temperature on the emulated rig: in motion, before a run, and on the way back."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from station.motion import FaultOrder
from station.records import Calibration, Interlock, State
from station.service import Runtime
from station.settings import EmulatedSettings, Settings
from tests.station.asking import asked

LIMIT_S = 30.0
OPEN = FaultOrder(device="inputs", kind="door_open", after_s=0.3)
HOT = FaultOrder(device="inputs", kind="temperature", temperature_c=75.5)
GONE = FaultOrder(device="inputs", kind="silent")


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Runtime]:
    settings = Settings(emulated=EmulatedSettings(speed=500.0))
    with Runtime.open(settings, tmp_path_factory.mktemp("doors")) as runtime:
        yield runtime


def run_with(runtime: Runtime, *orders: FaultOrder, kind: str = "rapid") -> Calibration:
    assert runtime.rig is not None
    runtime.rig.order(orders)
    try:
        run = runtime.orchestrator.submit(asked("R1", kind)).id
        assert runtime.orchestrator.wait(run, LIMIT_S).ended
    finally:
        runtime.rig.order([])
    return runtime.store.calibration(run)


def lock(runtime: Runtime, name: str) -> Interlock:
    (found,) = (one for one in runtime.orchestrator.snapshot().interlocks if one.id == name)
    return found


def test_a_door_that_opens_in_motion_ends_the_run_and_names_itself(runtime: Runtime) -> None:
    ended = run_with(runtime, OPEN)
    assert ended.state is State.FAILED
    assert "Guard door, on the way to position" in (ended.reason or "")
    (trip,) = (event.data for event in runtime.store.events(ended.id) if event.kind == "trip")
    assert (trip["interlock"], trip["text"]) == ("guard_door", ended.reason)
    frame_ms, standstill_ms = float(str(trip["stop_frame_after_ms"])), float(str(trip["standstill_after_ms"]))
    assert 0.0 <= frame_ms <= standstill_ms
    shown = lock(runtime, "guard_door").last_trip
    assert shown is not None
    assert (shown.run, shown.stop_frame_ms, shown.standstill_ms) == (ended.id, frame_ms, standstill_ms)
    changes = [(e.data["id"], e.data["ok"]) for e in runtime.store.events(ended.id) if e.kind == "interlock"]
    assert ("guard_door", False) in changes
    assert run_with(runtime).verdict == "pass"


@pytest.mark.parametrize(
    ("order", "said"),
    [
        (HOT, "The temperature is within its window: 75.5 °C, 0 to 60 °C are allowed"),
        (GONE, "The guard door is closed: it cannot be read"),
    ],
)
def test_no_run_starts_where_one_does_not_hold(runtime: Runtime, order: FaultOrder, said: str) -> None:
    ended = run_with(runtime, order)
    assert (ended.state, ended.step) == (State.FAILED, 0)
    assert said in (ended.reason or "")


def test_the_way_back_does_not_wait_for_the_temperature_but_for_the_door(runtime: Runtime) -> None:
    for axis, angle in zip(runtime.orchestrator._machine.devices.axes, (-45.0, 140.0), strict=True):
        axis.enable()
        axis.move_to(angle, 60.0)
    refused = run_with(runtime, OPEN.model_copy(update={"after_s": 0.0}), kind="retract")
    assert refused.state is State.FAILED
    assert "Guard door" in (refused.reason or "")
    assert run_with(runtime, HOT, kind="retract").state is State.SUCCEEDED
