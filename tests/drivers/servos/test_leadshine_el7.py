"""The servo driver against literal RTU frames."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from drivers.errors import DeviceFault, LinkLost
from drivers.lines.modbus import ModbusBus
from drivers.protocols import AxisStatus, ServoAxis
from drivers.scaling import JointScaling
from drivers.servos.leadshine_el7 import LeadshineEL7
from tests.drivers.wire import Exchange, PtyEnd, rtu, unanswered

SCALING = JointScaling(counts_per_rev=10_000, ratio=20, zero_at_deg=180.0, sign=1)


def ask(address: str, value: str, count: str = "0001") -> Exchange:
    """A read and its answer, in hexadecimal."""
    data = bytes.fromhex(value)
    return rtu(f"01 03 {address} {count}"), rtu(f"01 03 {len(data):02X} {value}")


def put(address: str, value: str) -> Exchange:
    """A single write and its echo."""
    return rtu(f"01 06 {address} {value}"), rtu(f"01 06 {address} {value}")


CONNECT = [
    ask("0003", "0006"),
    ask("0415", "0001"),
    ask("0417", "0002"),
    ask("0419", "0012"),
    ask("041B", "0003"),
    ask("041D", "0000"),
]
IDLE = [ask("0B05", "0032"), ask("602F", "000E")]
OFF = [ask("0B05", "0000"), ask("602F", "0002")]
RUNNING = [ask("0B05", "0006"), ask("602F", "000E")]
ALARMED = [ask("0B05", "0001"), ask("602F", "0001"), ask("0B02", "0180")]
FEEDBACK_AT_200_DEG = ask("602C", "0000 2B67", "0002")
MOVE_TO_200_DEG = rtu("01 10 6200 0008 10 0001 0000 2B67 0021 0064 0064 0000 0010")
MOVE_TAKEN = (MOVE_TO_200_DEG, rtu("01 10 6200 0008"))
STOP = put("6002", "0040")
LOOK = ask("0B05", "0032")
"""A stop is confirmed by a register that can be read: the reply to the write is a copy, as an echo is."""


@contextmanager
def axis(*exchanges: Exchange) -> Iterator[LeadshineEL7]:
    """A connected drive, addressed 1, that has `exchanges` before it."""
    with PtyEnd([*CONNECT, *exchanges]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?baud=115200", timeout_s=0.2)
        drive = LeadshineEL7(bus, 1, SCALING, name="servo axis 1")
        drive.connect()
        try:
            yield drive
        finally:
            drive.close()


def test_connect_checks_the_mode_and_finds_the_outputs() -> None:
    with axis() as drive:
        assert isinstance(drive, ServoAxis)
        assert drive.name == "servo axis 1"


@pytest.mark.parametrize(
    ("exchanges", "complaint"),
    [
        ([ask("0003", "0000")], r"control mode 0; set P00\.01 to 6"),
        ([*CONNECT[:3], ask("0419", "0004"), *CONNECT[4:]], "no output for servo-on"),
    ],
)
def test_a_drive_that_is_set_up_wrongly(exchanges: list[Exchange], complaint: str) -> None:
    with PtyEnd(exchanges) as end:
        drive = LeadshineEL7(ModbusBus(f"modbus+rtu://{end.port}"), 1, SCALING, name="servo axis 1")
        with pytest.raises(DeviceFault, match=complaint):
            drive.connect()


def test_enable_waits_until_the_drive_says_so() -> None:
    with axis(*OFF, put("0401", "0083"), *OFF, *IDLE) as drive:
        drive.enable()


def test_enable_whose_reply_is_lost_is_seen_in_the_state() -> None:
    with axis(*OFF, unanswered(put("0401", "0083")), *IDLE) as drive:
        drive.enable()


def test_enable_refuses_an_alarm() -> None:
    with axis(*ALARMED) as drive, pytest.raises(DeviceFault, match="Servo axis 1 shows alarm 180h"):
        drive.enable()


def test_a_move_is_one_frame_and_in_position_means_this_move() -> None:
    """20 deg = 11111 pulses, 10 deg/s = 33 rpm; a complete bit away from the target does not count."""
    with axis(
        *IDLE, MOVE_TAKEN, *RUNNING, *IDLE, ask("602C", "0000 0000", "0002"), *IDLE, FEEDBACK_AT_200_DEG
    ) as drive:
        drive.move_to(200.0, 10.0)
        assert drive.status() == AxisStatus(enabled=True, moving=True, in_position=False, alarm=None)
        assert not drive.status().in_position
        assert drive.status() == AxisStatus(enabled=True, moving=False, in_position=True, alarm=None)


def test_a_move_to_the_negative_side() -> None:
    frame = rtu("01 10 6200 0008 10 0001 FFFF D499 0021 0064 0064 0000 0010")
    with axis(*IDLE, (frame, rtu("01 10 6200 0008"))) as drive:
        drive.move_to(160.0, 10.0)


def test_a_move_whose_reply_is_lost_is_not_sent_again() -> None:
    """The target read back and the axis running say that it was taken."""
    target = ask("6201", "0000 2B67", "0002")
    with axis(*IDLE, unanswered(MOVE_TAKEN), target, RUNNING[0], ask("602C", "0000 0000", "0002")) as drive:
        drive.move_to(200.0, 10.0)
        assert drive.feedback_deg() == 180.0


def test_a_move_whose_reply_is_lost_and_which_the_drive_never_got() -> None:
    """It holds another target, so it is told once more: the move is absolute."""
    old_target = ask("6201", "0000 0000", "0002")
    with axis(*IDLE, unanswered(MOVE_TAKEN), old_target, MOVE_TAKEN) as drive:
        drive.move_to(200.0, 10.0)


def test_a_move_that_is_never_confirmed() -> None:
    lost, old_target = unanswered(MOVE_TAKEN), ask("6201", "0000 0000", "0002")
    with axis(*IDLE, lost, old_target, lost) as drive, pytest.raises(LinkLost, match="did not confirm"):
        drive.move_to(200.0, 10.0)


def test_a_move_that_was_taken_but_does_not_run_is_an_error() -> None:
    target, standing = ask("6201", "0000 2B67", "0002"), ask("602C", "0000 0000", "0002")
    with (
        axis(*IDLE, unanswered(MOVE_TAKEN), target, IDLE[0], standing) as drive,
        pytest.raises(LinkLost, match="did not confirm"),
    ):
        drive.move_to(200.0, 10.0)


def test_a_move_is_refused_while_off_or_in_alarm() -> None:
    with axis(*OFF, *ALARMED) as drive:
        with pytest.raises(DeviceFault, match="not switched on"):
            drive.move_to(200.0, 10.0)
        with pytest.raises(DeviceFault, match="alarm 180h"):
            drive.move_to(200.0, 10.0)


@pytest.mark.parametrize(
    ("theta_deg", "speed_deg_s", "complaint"),
    [
        (float("nan"), 10.0, "asked to move to nan"),
        (1e9, 10.0, "more pulses than it counts"),
        (200.0, 0.0, "asked for 0 deg/s"),
        (200.0, 1000.0, "0 to 900 is possible"),
        (200.0, float("nan"), "asked for nan deg/s"),
    ],
)
def test_a_move_that_makes_no_sense_never_reaches_the_wire(
    theta_deg: float, speed_deg_s: float, complaint: str
) -> None:
    with axis() as drive, pytest.raises(DeviceFault, match=complaint):
        drive.move_to(theta_deg, speed_deg_s)


def test_feedback_is_signed() -> None:
    with axis(ask("602C", "FFFF D499", "0002")) as drive:
        assert drive.feedback_deg() == pytest.approx(160.0002)


def test_reset_waits_until_the_alarm_is_gone() -> None:
    with axis(put("0033", "1111"), *ALARMED, *OFF) as drive:
        drive.reset_alarm()


def test_quick_stop_is_one_frame() -> None:
    with axis(
        (bytes.fromhex("01 06 60 02 00 40 37 FA"), bytes.fromhex("01 06 60 02 00 40 37 FA")), LOOK
    ) as drive:
        drive.quick_stop()


def test_quick_stop_is_repeated_when_unconfirmed() -> None:
    with axis(unanswered(STOP), STOP, LOOK) as drive:
        drive.quick_stop()


def test_quick_stop_is_repeated_when_a_late_reply_came_in_its_place() -> None:
    with axis((STOP[0], FEEDBACK_AT_200_DEG[1]), STOP, LOOK) as drive:
        drive.quick_stop()


def test_quick_stop_that_is_never_confirmed() -> None:
    lost = unanswered(STOP)
    with axis(lost, lost, lost) as drive, pytest.raises(LinkLost, match="use the emergency stop"):
        drive.quick_stop()


def test_after_a_stop_it_is_not_in_position() -> None:
    with axis(*IDLE, MOVE_TAKEN, STOP, LOOK, *IDLE) as drive:
        drive.move_to(200.0, 10.0)
        drive.make_safe()
        assert not drive.status().in_position


def test_make_safe_never_raises() -> None:
    lost = unanswered(STOP)
    with axis(lost, lost, lost) as drive:
        drive.make_safe()


def test_preset_declares_the_zero() -> None:
    with axis(*IDLE, put("6002", "0021"), ask("602C", "0000 0000", "0002")) as drive:
        drive.preset(180.0)


def test_preset_that_is_not_taken() -> None:
    with (
        axis(*IDLE, put("6002", "0021"), FEEDBACK_AT_200_DEG) as drive,
        pytest.raises(DeviceFault, match="11111 pulses after its zero was set"),
    ):
        drive.preset(180.0)


def test_preset_at_another_angle_or_moving_is_refused() -> None:
    with axis(*RUNNING) as drive:
        with pytest.raises(DeviceFault, match="can only be declared to stand at 180 deg"):
            drive.preset(181.0)
        with pytest.raises(DeviceFault, match="at standstill only"):
            drive.preset(180.0)


def test_unconnected_drive_closes_quietly() -> None:
    drive = LeadshineEL7(ModbusBus("modbus+rtu:///dev/nowhere"), 1, SCALING, name="servo axis 1")
    with pytest.raises(LinkLost):
        drive.connect()
    drive.make_safe()
    drive.close()
    drive.close()
