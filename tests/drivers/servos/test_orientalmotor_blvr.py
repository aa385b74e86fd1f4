"""The BLV-R driver against literal RTU frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event

import pytest

from drivers.driver import Drive
from drivers.errors import DeviceFault, LinkLost
from drivers.protocols import AxisStatus, ServoAxis
from drivers.scaling import JointScaling
from drivers.servos import SERVOS
from drivers.servos.orientalmotor_blvr import OrientalMotorSettings, _Feeder
from tests.drivers.wire import Exchange, PtyEnd, rtu, unanswered

DRIVE = Drive("servo axis 1", 1, JointScaling(counts_per_rev=10_000, ratio=20, zero_at_deg=180.0, sign=1))


def ask(address: str, value: str) -> Exchange:
    """A read of items and its answer, in hexadecimal."""
    data = bytes.fromhex(value)
    return rtu(f"01 03 {address} {len(data) // 2:04X}"), rtu(f"01 03 {len(data):02X} {value}")


def put(address: str, value: str) -> Exchange:
    """A write of items and its confirmation."""
    data = bytes.fromhex(value)
    count = f"{len(data) // 2:04X}"
    return rtu(f"01 10 {address} {count} {len(data):02X} {value}"), rtu(f"01 10 {address} {count}")


NO_WATCHDOG = [put("138A", "0000 0000"), ask("138A", "0000 0000")]
RESOLUTION = ask("0350", "0000 2710 0000 0001")
OFF, READY, MOVING, ARRIVED = (ask("007E", f"0000 {outputs}") for outputs in ("0010", "0019", "2019", "0219"))
ALARMED = [ask("007E", "0000 0090"), ask("0080", "0000 0085")]
SERVO_ON = put("007C", "0000 0001")
FEEDBACK_AT_200_DEG = ask("00CC", "0000 2B67")
FEEDBACK_AT_180_DEG = ask("00CC", "0000 0000")
MOVE_TO_200_DEG = put(
    "0058", "0000 0000 0000 0001 0000 2B67 0000 0021 0000 0064 0000 0064 0000 03E8 0000 0001"
)
STOP = put("007C", "0000 0011")


@contextmanager
def axis(*exchanges: Exchange, watchdog_ms: int = 0) -> Iterator[ServoAxis]:
    """A connected drive, addressed 1, that has `exchanges` before it."""
    first = [RESOLUTION] if watchdog_ms else [RESOLUTION, *NO_WATCHDOG]
    with PtyEnd([*first, *exchanges]) as end:
        settings = OrientalMotorSettings(
            url=f"modbus+rtu://{end.port}?baud=115200&format=8N1", timeout_s=0.2, watchdog_ms=watchdog_ms
        )
        (drive,) = SERVOS["orientalmotor"].make(settings, [DRIVE])
        drive.connect()
        try:
            yield drive
        finally:
            drive.close()


def test_the_makers_frames() -> None:
    """The check sums of this test's own far end against printed frames of the manual."""
    assert rtu("01 03 00F8 0004") == bytes.fromhex("01 03 00 F8 00 04 C5 F8")
    write = "04 10 005E 0006 0C 000003E8 000003E8 000007D0"
    assert rtu(write) == bytes.fromhex(write + " 43C0")


def test_connect_compares_the_resolution() -> None:
    with axis() as drive:
        assert isinstance(drive, ServoAxis)
    factory = ask("0350", "0000 8CA0 0000 0001")
    with PtyEnd([factory]) as end:
        settings = OrientalMotorSettings(url=f"modbus+rtu://{end.port}?format=8N1")
        (drive,) = SERVOS["orientalmotor"].make(settings, [DRIVE])
        with pytest.raises(DeviceFault, match="counts 36000/1 steps a turn, the station file says 10000"):
            drive.connect()


def test_the_watchdog_is_set_read_back_and_switched_off_at_the_end() -> None:
    with axis(put("138A", "0000 2710"), ask("138A", "0000 2710"), *NO_WATCHDOG, watchdog_ms=10_000):
        pass


def test_the_watchdog_is_fed_until_the_drive_is_closed() -> None:
    fed = Event()
    feeder = _Feeder(fed.set, lambda: math.inf, 0.001, "servo axis 1")
    assert fed.wait(5.0)
    fed.clear()
    assert fed.wait(5.0)
    feeder.close()
    fed.clear()
    assert not fed.wait(0.01)


def test_whoever_works_with_the_drive_feeds_it_as_well() -> None:
    fed, asked = Event(), Event()

    def heard_just_now() -> float:
        asked.set()
        return 0.0

    feeder = _Feeder(fed.set, heard_just_now, 0.001, "servo axis 1")
    assert asked.wait(5.0)
    asked.clear()
    assert asked.wait(5.0)
    feeder.close()
    assert not fed.is_set()


def test_a_watchdog_that_is_not_taken_is_refused() -> None:
    with PtyEnd([RESOLUTION, put("138A", "0000 00FA"), ask("138A", "0000 0000")]) as end:
        settings = OrientalMotorSettings(url=f"modbus+rtu://{end.port}?format=8N1")
        (drive,) = SERVOS["orientalmotor"].make(settings, [DRIVE])
        with pytest.raises(DeviceFault, match="watchdog of 0 ms instead of 250"):
            drive.connect()


def test_enable_waits_until_it_takes_moves() -> None:
    with axis(OFF, SERVO_ON, OFF, OFF, READY) as drive:
        drive.enable()


def test_a_drive_that_does_not_know_its_position_is_refused() -> None:
    with axis(OFF, SERVO_ON, ask("007E", "0000 0009")) as drive, pytest.raises(DeviceFault, match="home it"):
        drive.enable()


def test_a_move_is_one_frame_and_in_position_means_this_move() -> None:
    with axis(
        READY, SERVO_ON, MOVE_TO_200_DEG, MOVING, ARRIVED, FEEDBACK_AT_180_DEG, ARRIVED, FEEDBACK_AT_200_DEG
    ) as drive:
        drive.move_to(200.0, 10.0)
        assert drive.status() == AxisStatus(enabled=True, moving=True, in_position=False, alarm=None)
        assert not drive.status().in_position
        assert drive.status() == AxisStatus(enabled=True, moving=False, in_position=True, alarm=None)


def test_a_move_whose_reply_is_lost_is_not_sent_again_if_it_runs() -> None:
    with axis(READY, SERVO_ON, unanswered(MOVE_TO_200_DEG), ask("005C", "0000 2B67"), MOVING) as drive:
        drive.move_to(200.0, 10.0)


def test_a_stop_is_held_until_the_next_move() -> None:
    """A stop that somebody sent before this connection, too: the first move takes it back."""
    with axis(STOP, READY, READY, SERVO_ON, MOVE_TO_200_DEG) as drive:
        drive.quick_stop()
        drive.move_to(200.0, 10.0)


def test_a_stop_that_is_never_confirmed() -> None:
    with PtyEnd([RESOLUTION, *NO_WATCHDOG]) as end:
        settings = OrientalMotorSettings(
            url=f"modbus+rtu://{end.port}?format=8N1", timeout_s=0.3, watchdog_ms=0
        )
        (drive,) = SERVOS["orientalmotor"].make(settings, [DRIVE])
        drive.connect()
    with pytest.raises(LinkLost, match="use the emergency stop"):
        drive.quick_stop()
    drive.make_safe()
    drive.close()


def test_an_alarm_is_named_and_reset() -> None:
    with axis(*ALARMED, put("0180", "0000 0000"), put("0180", "0000 0001"), OFF) as drive:
        assert drive.status().alarm == 0x85
        drive.reset_alarm()


def test_feedback_is_signed() -> None:
    with axis(ask("00CC", "FFFF D499")) as drive:
        assert drive.feedback_deg() == pytest.approx(160.0002)


def test_preset_declares_the_zero() -> None:
    edge = [put("018A", "0000 0000"), put("018A", "0000 0001")]
    with axis(READY, *edge, FEEDBACK_AT_180_DEG, READY, *edge, FEEDBACK_AT_200_DEG, MOVING) as drive:
        drive.preset(180.0)
        with pytest.raises(DeviceFault, match="11111 pulses after its zero was set"):
            drive.preset(180.0)
        with pytest.raises(DeviceFault, match="can only be declared"):
            drive.preset(170.0)
        with pytest.raises(DeviceFault, match="is moving"):
            drive.preset(180.0)
