"""What changed in the station file between two starts is in the audit; secrets are not."""

from __future__ import annotations

from pathlib import Path

from station.records import AuditEntry
from station.service.settings_audit import record_settings
from station.settings import Settings
from station.store import Store


def changed(store: Store, **sections: object) -> list[AuditEntry]:
    """Start with these sections; the entries that it made, in order."""
    known = len(store.audit())
    record_settings(store, Settings.model_validate(sections))
    return store.audit()[::-1][known:]


def test_a_first_start_and_an_equal_one_change_nothing(store: Store) -> None:
    assert changed(store) == []
    assert changed(store) == []
    assert changed(store, limits={}) == [], "a default that is written down is the same"


def test_each_difference_is_told_with_both_values(store: Store) -> None:
    changed(store, limits={"speed_deg_s": 20})
    entries = changed(store, limits={"speed_deg_s": 25}, name="Line 4")
    assert [(e.action, e.subject, e.before, e.after) for e in entries] == [
        ("setting.changed", "setting limits.speed_deg_s", {"value": "20.0"}, {"value": "25.0"}),
        ("setting.changed", "setting name", {"value": '"Five-bar station"'}, {"value": '"Line 4"'}),
    ]
    assert entries[0].who and entries[0].via == "terminal"


def test_options_that_come_and_go_have_no_value_on_one_side(store: Store) -> None:
    changed(store)
    scale = {"protocol": "heidenhain-nd", "url": "serial:///dev/ttyUSB0"}
    servo = {"profile": "leadshine-el7", "url": "modbus+tcp://10.0.0.7:502"}
    came = {e.subject: e for e in changed(store, scale=scale, servo=servo)}
    url = came["setting servo.url"]
    assert (url.before, url.after) == (None, {"value": '"modbus+tcp://10.0.0.7:502"'})
    assert "setting servo.joint.2.unit" in came
    gone = {e.subject: e for e in changed(store)}
    assert gone["setting servo.url"].after is None


def test_a_changed_secret_is_told_without_its_value(store: Store, tmp_path: Path) -> None:
    def mqtt(password: str) -> dict[str, object]:
        return {"mqtt": [{"url": f"mqtts://station:{password}@broker:8883", "topic": "plant"}]}

    changed(store, outbox=mqtt("before-secret"))
    assert changed(store, outbox=mqtt("before-secret")) == []
    (entry,) = changed(store, outbox=mqtt("af@ter/after-secret"))
    assert entry.subject == "setting outbox.mqtt.1.url (secret part)"
    assert "not shown" in str(entry.before) and "not shown" in str(entry.after)
    store.close()
    assert b"-secret" not in (tmp_path / "station.db").read_bytes()
