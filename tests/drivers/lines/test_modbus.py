"""The Modbus line against literal frames: RTU on a pseudo-terminal, TCP on loopback."""

from __future__ import annotations

import os
import threading
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines.modbus import ModbusBus, UnansweredWrite
from drivers.lines.modbus_frames import find_rtu_reply, read_request
from drivers.lines.url import BadUrl
from tests.drivers.wire import NEW_CONNECTION, SILENCE, Exchange, PtyEnd, Say, TcpEnd, echoing_port, rtu
from tests.waiting import soon

READ_1000 = rtu("01 03 1000 0001")
READ_2000 = rtu("01 03 2000 0001")
STOP = bytes.fromhex("01 06 60 02 00 40 37 FA")
LOOK = (rtu("01 03 0B05 0001"), rtu("01 03 02 0002"))
STOPPED: tuple[Exchange, Exchange] = ((STOP, STOP), LOOK)


@contextmanager
def rtu_bus(
    *exchanges: Exchange, timeout_s: float = 0.2, budget_s: float | None = None
) -> Iterator[ModbusBus]:
    with PtyEnd(exchanges) as end:
        bus = ModbusBus(
            f"modbus+rtu://{end.port}?baud=115200&format=8N2", timeout_s=timeout_s, budget_s=budget_s
        )
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
    with rtu_bus(*STOPPED, (rtu("01 03 602C 0002"), rtu("01 03 04 FFFF 8000"))) as bus:
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        assert bus.read(1, 0x602C, 2) == [0xFFFF, 0x8000]


def test_a_lost_reply_to_a_read_is_asked_for_again() -> None:
    with rtu_bus((READ_1000, SILENCE), (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_silence_for_the_time_budget_is_a_lost_link() -> None:
    silent = (READ_1000, SILENCE)
    with (
        rtu_bus(silent, timeout_s=0.05, budget_s=0.0) as bus,
        pytest.raises(LinkLost, match="Drive 1 does not answer"),
    ):
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
    silent = (READ_1000, SILENCE)  # what fails later is not the cause
    named = pytest.raises(GarbledReply, match="2 registers instead of 1")
    with rtu_bus(wrong, silent, timeout_s=0.1, budget_s=0.25) as bus, named:
        bus.read(1, 0x1000, 1)


def test_a_reply_with_a_wrong_check_sum_is_no_reply() -> None:
    bad = (READ_1000, b"\x01\x03\x02\x11\x11\x00\x00")
    with rtu_bus(bad, (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_another_drives_reply_is_no_reply() -> None:
    with rtu_bus((READ_1000, rtu("02 03 02 9999")), (READ_1000, rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_a_write_is_confirmed_by_its_copy() -> None:
    frame = rtu("01 06 0401 0083")
    with rtu_bus((frame, frame), (READ_1000, rtu("01 03 02 1111"))) as bus:
        bus.write_one(1, 0x0401, 0x0083)
        assert bus.read(1, 0x1000, 1) == [0x1111]


def test_a_late_reply_does_not_shift_those_after_it() -> None:
    """The reply to the first request comes after its repetition; that to the repetition right behind it."""
    device, station = os.openpty()
    tty.setraw(station)
    replies = {0x1000: rtu("01 03 02 1111"), 0x1001: rtu("01 03 02 2222")}

    def play() -> None:
        asked = 0
        while asked < 3:
            address = int.from_bytes(os.read(device, 8)[2:4], "big")
            asked += 1
            if asked == 1:
                continue
            os.write(device, replies[address])
            if asked == 2:
                time.sleep(0.02)
                os.write(device, replies[address])

    drive = threading.Thread(target=play)
    drive.start()
    bus = ModbusBus(f"modbus+rtu://{os.ttyname(station)}?baud=115200", timeout_s=0.2)
    bus.open("test")
    try:
        assert [bus.read(1, address, 1) for address in (0x1000, 0x1001)] == [[0x1111], [0x2222]]
    finally:
        bus.release("test")
        drive.join()
        os.close(device)
        os.close(station)


def test_an_unanswered_write_is_not_sent_again() -> None:
    once = (rtu("01 06 0401 0083"), SILENCE)
    with rtu_bus(once) as bus, pytest.raises(UnansweredWrite, match="did not confirm"):
        bus.write_one(1, 0x0401, 0x0083)


def test_a_write_confirmed_differently_is_uncertain() -> None:
    odd = (rtu("01 06 0401 0083"), rtu("01 06 0401 0003"))
    with rtu_bus(odd) as bus, pytest.raises(UnansweredWrite, match="with other values"):
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
            (mbap(2, "06 0033 1111"), mbap(2, "86 0A")),
            (mbap(3, "06 0033 1111"), mbap(3, "86 06")),
            (mbap(4, "06 0033 1111"), mbap(4, "86 0B")),
        ]
    ) as end:
        bus = tcp_bus(end.port)
        bus.open("test")
        assert bus.read(1, 0x602C, 2) == [1, 0x86A0]
        with pytest.raises(UnansweredWrite):  # it went out: what did not reach the drive was sent again
            bus.write_one(1, 0x0033, 0x1111)
        bus.release("test")


def test_a_drive_that_is_busy_is_asked_again() -> None:
    """Exceptions 05 and 06 mean later; 0A and 0B come from a gateway whose line is being repaired."""
    ask = "03 602C 0002"
    with TcpEnd(
        [(mbap(k, ask), mbap(k, f"83 {code}")) for k, code in enumerate(("05", "06", "0A", "0B"), 1)]
        + [(mbap(5, ask), mbap(5, "03 04 0001 86A0"))]
    ) as end:
        bus = tcp_bus(end.port)
        bus.open("test")
        assert bus.read(1, 0x602C, 2) == [1, 0x86A0]
        bus.release("test")


def test_a_late_tcp_reply_is_told_by_its_number() -> None:
    late_too = mbap(7, "03 02 1111") + mbap(1, "03 02 2222")
    with TcpEnd([(mbap(1, "03 1000 0001"), late_too)]) as end:
        bus = tcp_bus(end.port, timeout_s=0.2)
        bus.open("test")
        assert bus.read(1, 0x1000, 1) == [0x2222]
        bus.release("test")


def test_a_connection_that_fell_silent_is_replaced() -> None:
    """A half-open connection never says so: the far end took the request, or not, and no reply comes."""
    ask = "03 1000 0001"
    with TcpEnd([(mbap(1, ask), SILENCE), NEW_CONNECTION, (mbap(2, ask), mbap(2, "03 02 2222"))]) as end:
        bus = tcp_bus(end.port, timeout_s=0.3)
        bus.open("test")
        assert bus.read(1, 0x1000, 1) == [0x2222]
        bus.release("test")


def test_a_stop_does_not_trust_an_old_connection() -> None:
    with TcpEnd(
        [
            (mbap(1, "03 1000 0001"), mbap(1, "03 02 1111")),
            NEW_CONNECTION,
            (mbap(2, "06 6002 0040"), mbap(2, "06 6002 0040")),
            NEW_CONNECTION,
            (mbap(3, "03 0B05 0001"), mbap(3, "03 02 0002")),
        ]
    ) as end:
        bus = tcp_bus(end.port)
        bus.open("test")
        bus.read(1, 0x1000, 1)
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        bus.release("test")


def test_an_echo_never_confirms_a_stop() -> None:
    """Function 06 is answered by a copy of the request, and an adapter that echoes gives one too."""
    with echoing_port() as port:
        bus = ModbusBus(f"modbus+rtu://{port}?baud=115200", timeout_s=0.3)
        with pytest.raises(GarbledReply, match=r"sends back what it is sent \(echo\)"):
            bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)


def test_an_adapter_that_echoes_is_named() -> None:
    with echoing_port() as port:
        bus = ModbusBus(f"modbus+rtu://{port}?baud=115200", timeout_s=0.3)
        bus.open("test")
        with pytest.raises(GarbledReply, match=r"\(echo\): switch the echo .* or add echo=1 to its address"):
            bus.read(1, 0x1000, 1)
        bus.release("test")


def test_an_adapter_that_echoes_is_used_as_its_address_says() -> None:
    answer = rtu("01 03 02 1111")
    with PtyEnd([(READ_1000, READ_1000 + answer), (STOP, STOP + STOP), (LOOK[0], LOOK[0] + LOOK[1])]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?baud=115200&echo=1")
        bus.open("test")
        assert bus.read(1, 0x1000, 1) == [0x1111]
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        bus.release("test")


def test_an_adapter_that_does_not_echo_although_its_address_says_so() -> None:
    with PtyEnd([(READ_1000, rtu("01 03 02 1111"))]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?baud=115200&echo=1", timeout_s=0.3)
        bus.open("test")
        with pytest.raises(GarbledReply, match="does not echo what it is sent, although its address says"):
            bus._ask(read_request(1, 0x1000, 1))
        bus.release("test")


@pytest.mark.parametrize("stray", [b"\x00", b"\x01", b"\x01\x03", b"\xff" * 7, STOP])
def test_a_reply_is_found_after_stray_bytes(stray: bytes) -> None:
    with rtu_bus((READ_1000, stray + rtu("01 03 02 1111"))) as bus:
        assert bus.read(1, 0x1000, 1) == [0x1111]


@given(st.binary(max_size=24), st.binary(max_size=8))
def test_no_bytes_but_the_reply_are_taken_for_it(before: bytes, after: bytes) -> None:
    request = read_request(1, 0x1000, 1)
    reply = rtu("01 03 02 1111")
    assert find_rtu_reply(before + reply + after, request) is not None
    broken = bytearray(reply)
    broken[3] ^= 0x40
    assert find_rtu_reply(bytes(broken), request) is None


def test_stops_go_out_one_after_the_other_before_any_is_repeated() -> None:
    """Drive 1 is silent: the stop of drive 2 does not wait for its time-out."""
    stop_2, look_2 = rtu("02 06 6002 0040"), (rtu("02 03 0B05 0001"), rtu("02 03 02 0002"))
    with rtu_bus((STOP, SILENCE), (stop_2, stop_2), look_2, *STOPPED, timeout_s=0.3) as bus:
        first = threading.Thread(target=lambda: bus.stop(1, 0x6002, 0x0040, look_at=0x0B05))
        first.start()
        bus.stop(2, 0x6002, 0x0040, look_at=0x0B05)
        first.join()


def test_a_drive_that_does_not_confirm_its_stop_is_not_accused_of_the_other_ones_answers() -> None:
    """The answers of both are collected together."""
    stop_2, look_2 = rtu("02 06 6002 0040"), (rtu("02 03 0B05 0001"), rtu("02 03 02 0002"))
    silent = [(STOP, SILENCE)] * 2
    with rtu_bus((STOP, SILENCE), (stop_2, stop_2), look_2, *silent, timeout_s=0.3) as bus:
        causes: list[str] = []

        def stop_1() -> None:
            with pytest.raises(LinkLost) as error:
                bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
            causes.append(str(error.value))

        first = threading.Thread(target=stop_1)
        first.start()
        bus.stop(2, 0x6002, 0x0040, look_at=0x0B05)
        first.join()
    assert causes[0].startswith("Drive 1 does not answer on ")


def test_a_drive_is_read_while_a_reply_of_another_is_overdue() -> None:
    """Otherwise one silent drive would hide that the other has come to standstill."""
    echoed, other = (READ_1000, READ_1000), (rtu("02 03 1000 0001"), rtu("02 03 02 2222"))
    with PtyEnd([echoed, other]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?baud=115200", timeout_s=1000.0, budget_s=0.0)
        bus.open("test")
        with pytest.raises(GarbledReply, match="echo"):
            bus.read(1, 0x1000, 1)
        read: list[int] = []
        threading.Thread(target=lambda: read.extend(bus.read(2, 0x1000, 1)), daemon=True).start()
        assert soon(lambda: read) == [0x2222]
        bus.release("test")


def test_a_stop_does_not_wait_for_a_reply_that_is_overdue() -> None:
    silent = (READ_1000, SILENCE)
    answered = (READ_1000, rtu("01 03 02 1111"))
    with rtu_bus(silent, *STOPPED, answered, timeout_s=1.0) as bus:
        sent_at_s = asked_at_s(bus)
        reader = Queue(bus, 0x1000)
        soon(lambda: sent_at_s)
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        reader.join()
    asked, stopped, *_ = sent_at_s
    assert stopped < asked + 1.0, "sent before the reader's own time-out"


def test_a_stop_on_a_line_that_nobody_opened() -> None:
    with PtyEnd([*STOPPED]) as end:
        ModbusBus(f"modbus+rtu://{end.port}").stop(1, 0x6002, 0x0040, look_at=0x0B05)


def test_a_line_whose_port_was_gone_during_a_stop_recovers(tmp_path: Path) -> None:
    """Both drives keep the line open: nobody opens it anew."""
    port = tmp_path / "port"
    with PtyEnd([]) as end:
        port.symlink_to(Path(end.port).readlink())
        bus = ModbusBus(f"modbus+rtu://{port}?baud=115200", timeout_s=0.1, budget_s=0.0)
        for owner in ("axis 1", "axis 2"):
            bus.open(owner)
    port.unlink()
    for ask in (
        lambda: bus.read(1, 0x1000, 1),
        lambda: bus.stop(1, 0x6002, 0x0040, look_at=0x0B05),
        lambda: bus.read(1, 0x1000, 1),
    ):
        with pytest.raises(LinkLost, match=r"broke while|there is no such port"):
            ask()
    with PtyEnd([(READ_1000, rtu("01 03 02 1111"))]) as end:
        port.symlink_to(Path(end.port).readlink())
        assert bus.read(1, 0x1000, 1) == [0x1111]
        for owner in ("axis 1", "axis 2"):
            bus.release(owner)


def test_rtu_frames_over_tcp() -> None:
    with TcpEnd([(READ_1000, SILENCE), NEW_CONNECTION, (READ_1000, rtu("01 03 02 1111"))]) as end:
        bus = ModbusBus(f"modbus+rtuovertcp://127.0.0.1:{end.port}", timeout_s=0.3)
        bus.open("test")
        assert bus.read(1, 0x1000, 1) == [0x1111]
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
    with pytest.raises(
        BadUrl, match=r"must begin with modbus\+rtu://, modbus\+tcp://, modbus\+rtuovertcp:// or"
    ):
        ModbusBus("tcp://127.0.0.1:502")


def test_the_line_stays_open_for_its_last_owner() -> None:
    with PtyEnd([(READ_1000, rtu("01 03 02 1111"))]) as end:
        bus = ModbusBus(f"modbus+rtu://{end.port}?format=8E1&override=8N1")
        assert bus.line.notice == f"{end.port} runs as 8N1 instead of 8E1, as its URL asks."
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
    seen: list[tuple[str, bytes]] = []
    reply = rtu("01 03 02 1111")
    with rtu_bus((READ_1000, reply)) as bus:
        bus.line.recorder = lambda what, data: seen.append((what, data))
        bus.read(1, 0x1000, 1)
    assert next(entry for entry in seen if entry[0] != "nothing") == ("tx", READ_1000)
    assert b"".join(data for way, data in seen if way == "rx") == reply


def asked_at_s(bus: ModbusBus) -> list[float]:
    """When each frame from now on was sent."""
    times: list[float] = []
    bus.line.recorder = lambda what, _: times.append(time.monotonic()) if what == "tx" else None
    return times


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
    slow = (READ_1000, Say(rtu("01 03 02 1111"), after_s=0.12))
    waiting = [(READ_1000, rtu("01 03 02 1111"))] * 11
    with rtu_bus(slow, *STOPPED, *waiting, timeout_s=0.9) as bus:
        sent_at_s = asked_at_s(bus)
        readers = [Queue(bus, 0x1000) for _ in range(11)]
        soon(lambda: sent_at_s)
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        for reader in readers:
            reader.join()
    assert all(reader.results for reader in readers)


def test_a_write_decided_before_a_stop_is_not_sent_after_it() -> None:
    with rtu_bus(*STOPPED) as bus:
        seen = bus.stops
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        with pytest.raises(DeviceFault, match="a stop came first"):
            bus.write(1, 0x6200, [1], stops_seen=seen)


def test_a_stop_does_not_wait_for_the_drain() -> None:
    """After a silent read the line is drained for its worst reply time; a stop goes out meanwhile."""
    silent = (READ_1000, SILENCE)
    answered = (READ_1000, rtu("01 03 02 1111"))
    with rtu_bus(silent, *STOPPED, answered, timeout_s=0.2) as bus:
        reader = Queue(bus, 0x1000)
        time.sleep(0.3)
        bus.stop(1, 0x6002, 0x0040, look_at=0x0B05)
        reader.join()
