"""Interlocks as data: declared, judged, and closed where something is not known."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest

from drivers.errors import LinkLost
from station.errors import InputRefused
from station.interlock_settings import InterlockSettings
from station.motion import Interlocks
from station.records import CalibrationHolds
from station.settings import LimitSettings, load_settings

DOOR = {"unit": 1, "address": 0x602E, "bit": 1}
WINDOW = {"unit": 3, "address": 1, "low_c": -5.0, "high_c": 30.0}


def interlocks(declared: dict[str, Any], registers: dict[tuple[int, int], int]) -> Interlocks:
    def read(unit: int, address: int) -> int:
        if (unit, address) not in registers:
            raise LinkLost(f"Drive {unit} does not answer.")
        return registers[unit, address]

    return Interlocks(InterlockSettings.model_validate(declared), LimitSettings(), read)


def detail(locks: Interlocks, name: str, serial: str = "R1") -> str:
    (found,) = (lock for lock in locks.views({}, serial) if lock.id == name)
    assert found.ok == (not found.detail)
    return found.detail


@pytest.mark.parametrize(
    ("closed", "register", "ok"), [(1, 2, True), (1, 5, False), (0, 5, True), (0, 2, False)]
)
def test_the_door_is_what_its_bit_says(closed: int, register: int, ok: bool) -> None:
    locks = interlocks({"guard_door": {**DOOR, "closed": closed}}, {(1, 0x602E): register})
    assert "not known" in detail(locks, "guard_door")  # before anybody looked
    assert (locks.look_at_guard_door() == "") is ok
    assert (detail(locks, "guard_door") == "") is ok


@pytest.mark.parametrize(
    ("register", "shows", "ok"),
    [(215, "21.5 °C", True), (0xFFF6, "-1.0 °C", True), (0xFFC0, "-6.4 °C", False), (301, "30.1 °C", False)],
)
def test_the_thermometer_counts_tenths_with_a_sign(register: int, shows: str, ok: bool) -> None:
    locks = interlocks({"temperature": WINDOW}, {(3, 1): register})
    locks.look_at_temperature()
    (found,) = (lock for lock in locks.views({}, "R1") if lock.id == "temperature")
    assert (found.shows, found.ok) == (shows, ok)
    assert found.limits == {"low_c": -5.0, "high_c": 30.0}


def test_what_cannot_be_read_does_not_hold() -> None:
    locks = interlocks({"guard_door": DOOR, "temperature": WINDOW}, {})
    for trouble in (locks.look_at_guard_door(), locks.look_at_temperature()):
        assert "cannot be read: Drive" in trouble
    without_registers = Interlocks(
        InterlockSettings.model_validate({"guard_door": DOOR}), LimitSettings(), None
    )
    assert "no line with registers" in without_registers.look_at_guard_door()


def test_a_broken_one_holds_again_when_nothing_moves() -> None:
    locks = interlocks({}, {})
    tripped = locks.trip("travel", "The rod slipped.")
    assert (tripped.interlock, str(tripped)) == ("travel", "The rod slipped.")
    assert detail(locks, "travel") == "The rod slipped."
    locks.hold_again()
    assert detail(locks, "travel") == ""


def test_limits_and_texts_are_those_of_the_station_file() -> None:
    locks = interlocks(
        {"travel": {"error_mm": 12.0, "text": "Rod firm"}, "workspace": {"outside_mm": 0.0}}, {}
    )
    assert (locks.travel_error_mm, locks.outside_mm, locks.following_error_deg) == (12.0, 0.0, 2.0)
    views = {lock.id: lock for lock in locks.views({}, "R1")}
    assert list(views) == ["devices", "drives", "workspace", "scale", "travel", "following_error"]
    assert (views["travel"].text, views["travel"].own_text) == ("Rod firm", True)
    assert views["travel"].limits == {"error_mm": 12.0}
    assert not views["scale"].own_text


NOW = datetime.now(UTC)


@pytest.mark.parametrize(
    ("state", "said"),
    [
        (CalibrationHolds(robot_serial="REF", locked=True, text="Locked: check 7 failed."), "check 7 failed"),
        (
            CalibrationHolds(robot_serial="REF", locked=False, text="Not checked yet."),
            "has not passed a check",
        ),
        (
            CalibrationHolds(
                robot_serial="REF",
                locked=False,
                text="",
                calibration_valid_until=NOW - timedelta(seconds=1),
            ),
            "was valid until",
        ),
        (
            CalibrationHolds(
                robot_serial="REF", locked=False, text="", calibration_valid_until=NOW + timedelta(hours=1)
            ),
            "",
        ),
    ],
)
def test_other_robots_wait_for_a_valid_check_of_the_reference_robot(
    state: CalibrationHolds, said: str
) -> None:
    declared = InterlockSettings.model_validate({"reference_check": {"robot": "REF"}})
    locks = Interlocks(declared, LimitSettings(), None, lambda _: state)
    assert "not known yet" in detail(locks, "reference_check")
    locks.look_at_reference()
    found = detail(locks, "reference_check")
    assert said in found if said else found == ""
    assert detail(locks, "reference_check", "REF") == ""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[interlocks.gate]\nunit = 1", 'there is no interlock "gate"; there is devices, drives, workspace'),
        ("[interlocks.guard_door]\nunit = 1", "[interlocks.guard_door] address is missing"),
        ("[interlocks.travel]\nerror_mm = -1", "[interlocks.travel] error_mm"),
        ("[interlocks.scale]\nlimit = 1", "[interlocks.scale] limit is not an option"),
        (
            "[interlocks.temperature]\nunit = 3\naddress = 1\nlow_c = 30\nhigh_c = 20",
            "low_c must be below high_c",
        ),
    ],
)
def test_what_cannot_be_declared_is_refused_in_one_sentence(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "station.toml"
    path.write_text(text)
    with pytest.raises(InputRefused) as refused:
        load_settings(path)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
