"""The emulated display, byte by byte against the maker's tables."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.emulated.faults import Faults
from drivers.emulated.machine import Unreachable
from drivers.emulated.nd280 import ND280
from drivers.emulated.spec import Fault

STX, ENQ, ACK, NAK = b"\x02", b"\x05", b"\x06", b"\x15"


def display(head_mm: float = 121.975, *faults: Fault) -> ND280:
    return ND280(lambda: head_mm, Faults(faults))


def say(device: ND280, *requests: bytes) -> list[bytes]:
    return [reply.data for request in requests for reply in device.receive(request)]


@pytest.mark.parametrize(
    ("head_mm", "line"),
    [
        (121.975, b"+  121.9750    \r\n"),
        (-0.0005, b"-    0.0005    \r\n"),
        (99999.99994, b"+99999.9999    \r\n"),
    ],
)
def test_measured_value_line_has_17_characters(head_mm: float, line: bytes) -> None:
    assert len(line) == 17
    assert say(display(head_mm), STX) == [line]


@pytest.mark.parametrize(
    ("command", "reply"),
    [
        (b"\x1bA0000\r", b"\x02ND281B    \r\n 349797-03\r\n          \r\n"),
        (b"\x1bA0100\r", b"\x02+121.9750\r\n"),
        (b"\x1bA0200\r", b"\x02+001219750\r\n"),
        (b"\x1bA0301\r", NAK),
        (b"\x1bA0400\r", b"\x02 349797-03\r\n"),
        (b"\x1bA0900\r", b"\x0211000000000000\r\n"),
        (b"\x1bA7777\r", NAK),
        (b"\x1bT0104\r", ACK),
        (b"\x1bT9999\r", NAK),
        (b"\x1bF0200\r", ACK + b"+  121.9750    \r\n"),
        (b"\x1bF9999\r", NAK),
        (b"\x1bS0001\r", ACK),
        (b"\x1bS9999\r", NAK),
        (b"\x1bX0000\r", NAK),
        (b"\x1bA00\r", NAK),
        (b"\x1bA0000000", NAK),
        (ENQ, b"             \r\n"),
    ],
)
def test_commands(command: bytes, reply: bytes) -> None:
    assert say(display(), command)[:1] == [reply]


def test_a_command_may_come_in_pieces_and_noise_is_skipped() -> None:
    assert say(display(), b"??\x1bA0", b"200", b"\r") == [b"\x02+001219750\r\n"]


def test_zero_is_set_with_the_keys() -> None:
    """There is no preset command: CL, digits, point, minus, ENT."""
    device = display()
    say(device, *[b"\x1bT%04d\r" % key for key in (100, 1, 102, 5, 101, 104)])
    assert say(device, STX) == [b"-    1.5000    \r\n"]
    say(device, b"\x1bS0001\r", b"\x1bT0009\r", b"\x1bT0104\r", b"\x1bS0002\r")  # locked keys do nothing
    assert say(device, STX) == [b"-    1.5000    \r\n"]
    say(device, b"\x1bS0000\r")
    assert say(device, STX) == [b"+  121.9750    \r\n"]


def test_fault_mark_comes_with_its_text() -> None:
    device = display(121.975, Fault(kind="scale_fault_mark"))
    assert say(device, STX) == [b"+  121.9750 ?  \r\n"]
    assert say(device, b"\x1bA0301\r", ENQ) == [b"\x02FORMAT ERR.  \r\n", b"FORMAT ERR.  \r\n"]
    assert say(device, STX, b"\x1bA0301\r") == [b"+  121.9750    \r\n", NAK]


def test_scripted_faults_come_when_they_should() -> None:
    device = display(121.975, Fault(kind="scale_silent", after=1, times=2), Fault(kind="scale_garbled"))
    assert say(device, STX) != [b"+  121.9750    \r\n"]
    assert say(device, STX, STX) == []
    assert say(device, STX) == [b"+  121.9750    \r\n"]
    late = display(121.975, Fault(kind="scale_late", delay_s=0.7)).receive(STX)
    assert [(reply.data, reply.delay_s) for reply in late] == [(b"+  121.9750    \r\n", 0.7)]


def test_a_head_off_its_scale_is_a_fault() -> None:
    def off_scale() -> float:
        raise Unreachable

    device = ND280(off_scale, Faults())
    assert say(device, STX) == [b"+    0.0000 ?  \r\n"]
    assert say(device, b"\x1bA0200\r") == [NAK]


@given(st.lists(st.binary(max_size=12), max_size=6))
def test_any_bytes_are_survived(pieces: list[bytes]) -> None:
    """Noise is skipped or refused; after enough carriage returns the display listens again."""
    device = display()
    say(device, *pieces, b"\r" * 8)
    assert say(device, b"\x1bA0200\r", STX)[-1].endswith(b"  \r\n")
