"""The emulated drive: its registers and refusals, in request and reply PDUs."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from drivers.emulated.el7 import EL7Drive
from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine
from drivers.emulated.spec import Fault, MachineSpec
from drivers.emulated.virtual import VirtualClock

SERVO_ON = "06 0401 0083"
MOVE = "10 6200 0008 10 0001 0000 2710 0064 0064 0064 0000 0010"
FEEDBACK = "03 602C 0002"
STATUS = "03 0B05 0001"


class Bench:
    """One drive on a machine in virtual time."""

    def __init__(self, *faults: Fault) -> None:
        self.clock = VirtualClock()
        self.machine = Machine(MachineSpec(scatter=False), self.clock)
        self._drive = EL7Drive(self.machine, 1, Faults(faults))

    def ask(self, request: str) -> str:
        return self._drive.answer(bytes.fromhex(request)).hex()

    def wait(self) -> None:
        self.clock.advance_to(self.machine.rests_from_s)


@pytest.mark.parametrize(
    ("request_pdu", "reply"),
    [
        ("04 602C 0002", "8401"),
        ("17", "9701"),
        ("03 1234 0001", "8302"),
        ("03 602F 0002", "8302"),
        ("03 602C 0000", "8303"),
        ("03 602C 007E", "8303"),
        ("06 1234 0000", "8602"),
        ("06 602C 0000", "8602"),  # the position is not for writing
        ("06 6002 0099", "8603"),
        ("10 6200 0002 04 0001", "9003"),
        ("10 6206 0003 06 0000 0000 0000", "9002"),
    ],
)
def test_refusals(request_pdu: str, reply: str) -> None:
    assert Bench().ask(request_pdu) == reply


def test_a_move_is_refused_until_it_is_enabled() -> None:
    bench = Bench()
    assert bench.ask(MOVE) == "9003"
    assert bench.ask(SERVO_ON) == "0604010083"
    assert bench.ask(MOVE) == "1062000008"


def test_state_while_moving_and_after() -> None:
    bench = Bench()
    bench.ask(SERVO_ON)
    bench.ask(MOVE)
    assert bench.ask(STATUS) == "03020006"  # enabled, running
    bench.wait()
    assert bench.ask(STATUS) == "03020032"  # enabled, command and path complete
    assert bench.ask(FEEDBACK) == "030400002710"
    assert bench.ask("03 0B1C 0002") == "030400002710"
    assert bench.ask("03 602F 0001") == "0302000e"


def test_relative_move_and_negative_position() -> None:
    bench = Bench()
    bench.ask(SERVO_ON)
    for _ in range(2):
        bench.ask("10 6200 0008 10 0041 FFFF D8F0 0064 0064 0064 0000 0010")
        bench.wait()
    assert bench.ask(FEEDBACK) == "0304ffffb1e0"


def test_quick_stop_leaves_the_path_incomplete() -> None:
    bench = Bench()
    bench.ask(SERVO_ON)
    bench.ask(MOVE)
    bench.clock.advance_to(0.1)
    assert bench.ask("06 6002 0040") == "0660020040"
    bench.wait()
    assert bench.ask(STATUS) == "03020002"


def test_declaring_zero_needs_standstill() -> None:
    bench = Bench()
    bench.ask(SERVO_ON)
    bench.ask(MOVE)
    assert bench.ask("06 6002 0021") == "8603"
    bench.wait()
    assert bench.ask("06 6002 0021") == "0660020021"
    assert bench.ask(FEEDBACK) == "030400000000"


def test_scripted_alarm_stops_and_is_reset() -> None:
    bench = Bench(Fault(kind="drive_alarm", joint=1, after=1, code=0xE0))
    bench.ask(SERVO_ON)
    bench.ask(MOVE)
    bench.wait()
    bench.ask(MOVE)
    assert bench.ask("03 0B02 0001") == "030200e0"
    assert bench.ask("03 602F 0001") == "03020001"
    assert bench.ask(MOVE) == "9003"
    assert bench.ask("06 0033 1111") == "0600331111"
    assert bench.ask("03 0B02 0001") == "03020000"
    assert bench.ask(MOVE) == "1062000008"


def test_scripted_exception_and_a_move_without_end() -> None:
    bench = Bench(Fault(kind="drive_exception", code=2), Fault(kind="drive_never_in_position"))
    assert bench.ask(SERVO_ON) == "8602"
    bench.ask(SERVO_ON)
    bench.ask(MOVE)
    bench.wait()
    assert bench.ask(STATUS) == "03020002"
    bench.ask(MOVE)
    assert bench.ask(STATUS) == "03020032"


@given(st.binary(min_size=1, max_size=30))
@example(bytes.fromhex("10 6200 0008 10"))
@example(bytes.fromhex("06 60"))
def test_any_request_gets_a_reply(request_pdu: bytes) -> None:
    """Whatever a master sends: an echo of its function or an exception, never a crash."""
    reply = EL7Drive(Machine(MachineSpec(), VirtualClock()), 1, Faults()).answer(request_pdu)
    assert reply[0] & 0x7F == request_pdu[0] & 0x7F
