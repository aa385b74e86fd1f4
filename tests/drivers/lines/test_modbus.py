"""The Modbus line against literal frames: RTU on a pseudo-terminal, TCP on loopback."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

import pytest

from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines.modbus import ModbusBus, UnansweredWrite
from drivers.lines.url import BadUrl
from tests.drivers.wire import SILENCE, Exchange, PtyEnd, Say, TcpEnd, rtu

READ_1000 = rtu("01 03 1000 0001")
READ_2000 = rtu("01 03 2000 0001")
STOP = bytes.fromhex("01 06 60 02 00 40 37 FA")


@contextmanager
def rtu_bus(*exchanges: Exchange, timeout_s: float = 0.2) -> Iterator[ModbusBus]:
    with PtyEnd(exchanges) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?baud=115200&format=8N2", timeout_s=timeout_s)
        bus.open("test")
        try:
            yield bus
        finally:
            bus.release("test")


def tcp_bus(port: int, timeout_s: float = 0.3) -> ModbusBus:
    return ModbusBus(f"modbus+tcp://127.0.0.1:{port}", timeout_s=timeout_s)


def test_golden_frames_of_the_maker() -> None:
    """The check sums of this test's own far end against printed frames."""
    assert rtu("01 06 6002 0040") == STOP
    assert rtu("01 06 6002 0010") == bytes.fromhex("01 06 60 02 00 10 37 C6")
    move = "11 10 6200 0008 10 0001 0001 86A0 01F4 0064 0064 0000 0010"
    assert rtu(move) == bytes.fromhex(move) + b"\x67\xb3"


def test_a_move_is_one_frame() -> None:
    move = bytes.fromhex("11 10 6200 0008 10 0001 0001 86A0 01F4 0064 0064 0000 0010 67B3")
    with rtu_bus((move, rtu("11 10 6200 0008"))) as bus:
        bus.write(0x11, 0x6200, [1, 1, 0x86A0, 500, 100, 100, 0, 0x10], stops_seen=bus.stops)


def test_another_models_golden_exchange() -> None:
    move = bytes.fromhex("07 10 6200 0008 10 0001 0000 2710 0000 2710 2710 0000 0010 8D50")
    with rtu_bus((move, bytes.fromhex("07 10 62 00 00 08 DE 11"))) as bus:
        bus.write(7, 0x6200, [1, 0, 10000, 0, 10000, 10000, 0, 0x10], stops_seen=bus.stops)


def test_stop_and_read() -> None:
    with rtu_bus((STOP, STOP), (rtu("01 03 602C 0002"), rtu("01 03 04 FFFF 8000"))) as bus:
        bus.write_one(1, 0x6002, 0x0040, urgent=True)
        assert bus.read(1, 0x602C, 2) == [0xFFFF, 0x8000]


def test_a_lost_reply_to_a_read_is_asked_for_again() -> None:
    with rtu_bus((READ_1000, SILENCE), (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_three_lost_replies_are_a_lost_link() -> None:
    silent = (READ_1000, SILENCE)
    with rtu_bus(silent, silent, silent) as bus, pytest.raises(LinkLost, match="Drive 1 does not answer"):
        bus.read(1, 0x1000, 1)


def test_a_late_reply_is_not_taken_for_the_next() -> None:
    """Without draining, the read of 2000h would return the data of 1000h."""
    late = (READ_1000, Say(rtu("01 03 02 1111"), after_s=0.3))
    again = (READ_1000, rtu("01 03 02 3333"))
    other = (READ_2000, rtu("01 03 02 2222"))
    with rtu_bus(late, again, other) as bus:
        assert bus.read(1, 0x1000, 1) == [0x3333]
        assert bus.read(1, 0x2000, 1) == [0x2222]


def test_a_reply_of_the_wrong_length_is_asked_for_again() -> None:
    with rtu_bus((READ_1000, rtu("01 03 04 1111 2222")), (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_replies_of_the_wrong_length_are_garbled() -> None:
    wrong = (READ_1000, rtu("01 03 04 1111 2222"))
    with rtu_bus(wrong, wrong, wrong) as bus, pytest.raises(GarbledReply, match="2 registers instead of 1"):
        bus.read(1, 0x1000, 1)


def test_a_reply_with_a_wrong_check_sum_is_no_reply() -> None:
    bad = (READ_1000, b"\x01\x03\x02\x11\x11\x00\x00")
    with rtu_bus(bad, (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_another_drives_reply_is_no_reply() -> None:
    with rtu_bus((READ_1000, rtu("02 03 02 9999")), (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_an_unanswered_write_is_not_sent_again() -> None:
    once = (rtu("01 06 0401 0083"), SILENCE)
    with rtu_bus(once) as bus, pytest.raises(UnansweredWrite, match="did not confirm"):
        bus.write_one(1, 0x0401, 0x0083)


def test_a_write_confirmed_differently_is_uncertain() -> None:
    odd = (rtu("01 06 0401 0083"), rtu("01 06 0401 0003"))
    with rtu_bus(odd) as bus, pytest.raises(UnansweredWrite, match="confirmed another command"):
        bus.write_one(1, 0x0401, 0x0083)


@pytest.mark.parametrize(
    ("code", "kind", "complaint"),
    [
        ("01", DeviceFault, "does not know the function"),
        ("02", DeviceFault, "no such register"),
        ("03", DeviceFault, "refuses the value"),
        ("04", DeviceFault, "exception 04"),
    ],
)
def test_refusals_are_named_and_not_repeated(code: str, kind: type[Exception], complaint: str) -> None:
    with rtu_bus((READ_1000, rtu(f"01 83 {code}"))) as bus, pytest.raises(kind, match=complaint):
        bus.read(1, 0x1000, 1)


def test_a_check_sum_complaint_of_the_drive_is_asked_again() -> None:
    golden = bytes.fromhex("01 83 08 40 F6")
    with rtu_bus((READ_1000, golden), (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def mbap(transaction: int, pdu: str, unit: int = 1) -> bytes:
    body = bytes([unit]) + bytes.fromhex(pdu)
    return transaction.to_bytes(2, "big") + b"\0\0" + len(body).to_bytes(2, "big") + body


def test_tcp_exchange_and_gateway_exceptions() -> None:
    ask = "03 602C 0002"
    with TcpEnd(
        [
            (mbap(1, ask), mbap(1, "03 04 0001 86A0")),
            (mbap(2, ask), mbap(2, "83 0B")),
            (mbap(3, ask), mbap(3, "83 0B")),
            (mbap(4, ask), mbap(4, "83 0B")),
            (mbap(5, "06 6002 0040"), mbap(5, "86 0A")),
            (mbap(6, "06 6002 0040"), mbap(6, "86 0B")),
        ]
    ) as end:
        bus = tcp_bus(end.port)
        bus.open("test")
        assert bus.read(1, 0x602C, 2) == [1, 0x86A0]
        with pytest.raises(LinkLost, match="does not answer the gateway"):
            bus.read(1, 0x602C, 2)
        with pytest.raises(LinkLost, match="has no path") as caught:
            bus.write_one(1, 0x6002, 0x40)
        assert not isinstance(caught.value, UnansweredWrite)  # it never went out
        with pytest.raises(UnansweredWrite):
            bus.write_one(1, 0x6002, 0x40)
        bus.release("test")


def test_a_late_tcp_reply_is_told_by_its_number() -> None:
    with TcpEnd(
        [
            (mbap(1, "03 1000 0001"), Say(mbap(1, "03 02 1111"), after_s=0.3)),
            (mbap(2, "03 1000 0001"), mbap(2, "03 02 2222")),
        ]
    ) as end:
        bus = tcp_bus(end.port, timeout_s=0.2)
        bus.open("test")
        assert bus.read(1, 0x1000, 1) == [0x2222]
        bus.release("test")


def test_nobody_listens() -> None:
    with TcpEnd([]) as end:
        pass
    with pytest.raises(LinkLost, match="cannot be reached"):
        tcp_bus(end.port).open("test")


def test_a_missing_port_is_a_lost_link() -> None:
    with pytest.raises(LinkLost, match="there is no such port"):
        ModbusBus("modbus+rtu:///dev/nowhere").open("test")


def test_parity_on_a_pseudo_terminal_needs_the_override() -> None:
    with PtyEnd([]) as end, pytest.raises(DeviceError, match="cannot carry 8E1"):
        ModbusBus(f"modbus+rtu://{end.port}?format=8E1").open("test")


def test_a_port_that_is_held_is_a_lost_link() -> None:
    with PtyEnd([]) as end:
        first, second = ModbusBus(f"modbus+rtu://{end.port}"), ModbusBus(f"modbus+rtu://{end.port}")
        first.open("test")
        with pytest.raises(LinkLost, match="another program holds it"):
            second.open("test")
        first.release("test")


def test_a_bad_url_is_refused_at_once() -> None:
    with pytest.raises(BadUrl, match=r"must begin with modbus\+rtu:// or modbus\+tcp://"):
        ModbusBus("tcp://127.0.0.1:502")


def test_the_line_stays_open_for_its_last_owner() -> None:
    with PtyEnd([(READ_1000, rtu("01 03 02 1111"))]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?format=8E1&override=8N1")
        assert bus.notice == f"{end.port} runs as 8N1 instead of 8E1, as its URL asks."
        first, second = object(), object()
        bus.open(first)
        bus.open(second)
        bus.release(first)
        assert bus.read(1, 0x1000, 1) == [0x1111]
        bus.release(second)


def test_pulling_the_cable_is_a_lost_link() -> None:
    with PtyEnd([(READ_1000, rtu("01 03 02 1111"))]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}", timeout_s=0.1)
        bus.open("test")
        bus.read(1, 0x1000, 1)
    with pytest.raises(LinkLost):
        bus.read(1, 0x1000, 1)
    bus.release("test")


def test_the_flight_recorder_sees_both_directions() -> None:
    seen: list[tuple[Literal["tx", "rx"], bytes]] = []
    reply = rtu("01 03 02 1111")
    with rtu_bus((READ_1000, reply)) as bus:
        bus.trace = lambda direction, data: seen.append((direction, data))
        bus.read(1, 0x1000, 1)
    assert seen[0] == ("tx", READ_1000)
    assert b"".join(data for way, data in seen if way == "rx") == reply


class Queue:
    """A reader that holds the line, and others that wait behind it."""

    def __init__(self, bus: ModbusBus, address: int) -> None:
        self.results: list[int] = []
        self._thread = threading.Thread(target=lambda: self.results.extend(bus.read(1, address, 1)))
        self._thread.start()

    def join(self) -> None:
        self._thread.join()


def test_a_stop_passes_all_that_wait() -> None:
    """Ten readers queue behind a slow one; the stop's frame is the very next on the wire."""
    slow = (READ_1000, Say(rtu("01 03 02 1111"), after_s=0.2))
    waiting = [(READ_2000, rtu("01 03 02 2222"))] * 10
    with rtu_bus(slow, (STOP, STOP), *waiting, timeout_s=1.0) as bus:
        readers = [Queue(bus, 0x1000)]
        time.sleep(0.05)
        readers += [Queue(bus, 0x2000) for _ in range(10)]
        time.sleep(0.05)
        bus.write_one(1, 0x6002, 0x0040, urgent=True)
        for reader in readers:
            reader.join()
    assert all(reader.results for reader in readers)


def test_a_write_decided_before_a_stop_is_not_sent_after_it() -> None:
    with rtu_bus((STOP, STOP)) as bus:
        seen = bus.stops
        bus.write_one(1, 0x6002, 0x0040, urgent=True)
        with pytest.raises(DeviceFault, match="a stop came first"):
            bus.write(1, 0x6200, [1], stops_seen=seen)


def test_a_stop_does_not_wait_for_the_drain() -> None:
    """After a silent read the line is drained for its worst reply time; a stop goes out meanwhile."""
    silent = (READ_1000, SILENCE)
    answered = (READ_1000, rtu("01 03 02 1111"))
    with rtu_bus(silent, (STOP, STOP), answered, timeout_s=0.5) as bus:
        reader = Queue(bus, 0x1000)
        time.sleep(0.7)
        bus.write_one(1, 0x6002, 0x0040, urgent=True)
        reader.join()
