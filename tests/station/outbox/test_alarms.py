"""Each trouble is told once, when it begins."""

from __future__ import annotations

from station.outbox import Alarms
from station.records import DeviceState, DeviceView, Interlock
from station.store.store import Store


def device(state: DeviceState, text: str = "") -> DeviceView:
    return DeviceView(name="axis 1", kind="axis", address="fake://1", state=state, text=text)


def test_a_device_and_an_interlock_alarm_once_each_time_they_fail(store: Store) -> None:
    alarms = Alarms(store)
    for view in (device("unknown"), device("lost", "nothing answers"), device("fault"), device("ok")):
        alarms.device(view)
    alarms.device(device("lost"))
    shut = Interlock(id="enable", text="Drives are enabled", ok=True)
    for ok in (True, False, False):
        alarms.interlocks((shut.model_copy(update={"ok": ok, "detail": "" if ok else "axis 2 is not"}),))
    assert [(e.type, e.data["source"], e.data["text"]) for e in store.happenings()] == [
        ("alarm", "axis 1", "nothing answers"),
        ("alarm", "axis 1", "lost"),
        ("alarm", "enable", "Drives are enabled: axis 2 is not"),
    ]
