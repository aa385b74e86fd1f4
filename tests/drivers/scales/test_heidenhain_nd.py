"""The display's driver against literal bytes of the maker's tables."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.protocols import LinearScale
from drivers.scales.heidenhain_nd import HeidenhainND, Indicator
from tests.drivers.wire import NEW_CONNECTION, SILENCE, Exchange, PtyEnd, Say, TcpEnd

IDENTITY = (b"\x1bA0000\r", b"\x02ND281B    \r\n 349797-03\r\n")
INDICATORS = (b"\x1bA0900\r", b"\x0211000000000000\r\n")
VALUE = (b"\x02", b"+  121.9750    \r\n")
CURRENT = (b"\x1bA0200\r", b"\x02+001219750\r\n")
OPENED: Exchange = (b"\x11", SILENCE)
"""XON: whoever paused the display may be gone."""
CONNECT: list[Exchange] = [OPENED, IDENTITY, INDICATORS, VALUE, CURRENT]


@contextmanager
def connected(
    *exchanges: Exchange, timeout_s: float = 0.1, budget_s: float | None = None
) -> Iterator[HeidenhainND]:
    """A driver that has connected and has `exchanges` before it."""
    with PtyEnd([*CONNECT, *exchanges]) as end:
        scale = HeidenhainND(f"serial://{end.port}?override=8N1", timeout_s=timeout_s, budget_s=budget_s)
        scale.connect()
        try:
            yield scale
        finally:
            scale.close()


def test_connect_reads_the_model_and_compares_both_values() -> None:
    with connected() as scale:
        assert scale.identity == ("ND281B", "349797-03")
        assert isinstance(scale, LinearScale)


def test_reads_the_value_line() -> None:
    with connected((b"\x02", b"-    0.0005    \r\n")) as scale:
        assert scale.read_mm() == -0.0005


def test_sign_number_and_sorting() -> None:
    with connected(
        (b"\x02", b"-  12.34567    \r\n"),
        (b"\x02", b"+     .0001   A\r\n"),
        (b"\x02", b"+1234567.12  < \r\n"),
    ) as scale:
        assert scale.read_mm() == -12.34567
        assert scale.read_mm() == 0.0001
        assert scale.read_mm() == 1234567.12


def test_the_flight_recorder_sees_both_directions() -> None:
    seen = []
    with connected(VALUE) as scale:
        scale.line.recorder = lambda what, data: seen.append((what, data))
        scale.read_mm()
    assert b"".join(data for way, data in seen if way == "tx") == VALUE[0]
    assert b"".join(data for way, data in seen if way == "rx") == VALUE[1]


def test_value_over_the_network() -> None:
    with TcpEnd([*CONNECT, VALUE]) as end:
        scale = HeidenhainND(f"socket://127.0.0.1:{end.port}", timeout_s=0.5)
        scale.connect()
        assert scale.read_mm() == 121.975
        assert scale.line.notice is None
        scale.close()


def test_flow_control_is_no_part_of_the_line() -> None:
    with connected((b"\x02", b"+  121\x13\x11.9750    \r\n")) as scale:
        assert scale.read_mm() == 121.975


def test_indicators_have_names() -> None:
    with connected((b"\x1bA0900\r", b"\x022010000000\r\n")) as scale:
        shown = scale.indicators()
    assert shown["REF"] is Indicator.BLINKING
    assert shown["datum 2"] is Indicator.LIT
    assert "ACTL" not in shown


def test_error_text_and_none() -> None:
    with connected((b"\x1bA0301\r", b"\x02REC. ERROR   \r\n"), (b"\x1bA0301\r", b"\x15")) as scale:
        assert scale.error_text() == "REC. ERROR"
        assert scale.error_text() is None


def test_fault_mark_is_named() -> None:
    with (
        connected((b"\x02", b"+    0.0000 ?  \r\n"), (b"\x1bA0301\r", b"\x02FORMAT ERR.  \r\n")) as scale,
        pytest.raises(DeviceFault, match=r"marks its value as faulty: FORMAT ERR\."),
    ):
        scale.read_mm()


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        (b'+   12.3450 "  \r\n', "counts in inches"),
        (b"+   12.3450 G  \r\n", 'unit "G"'),
        (b"+   12.3450  ? \r\n", "sorting limits"),
        (b"+   12.3450   S\r\n", "shows MIN instead"),
        (b"+   12.3450   G\r\n", "shows MAX instead"),
    ],
)
def test_a_line_that_is_no_present_value_in_mm(line: bytes, complaint: str) -> None:
    with connected((b"\x02", line)) as scale, pytest.raises(DeviceFault, match=complaint):
        scale.read_mm()


def test_a_garbled_line_is_asked_for_again_after_the_line_is_clean() -> None:
    with connected((b"\x02", b"+  1#1.9750    \r\n"), IDENTITY, VALUE) as scale:
        assert scale.read_mm() == 121.975


def test_what_is_garbled_for_the_time_budget_is_an_error() -> None:
    bad = (b"\x02", b"+  121.97 0    \r\n")
    with connected(bad, budget_s=0.0) as scale, pytest.raises(GarbledReply, match="not a r"):
        scale.read_mm()


@pytest.mark.parametrize("at", [0, 1, 5, 12, 13, 14, 15])
def test_a_byte_that_the_line_marks_as_bad_is_refused(at: int) -> None:
    """A byte of wrong parity arrives as NUL, wherever it stands."""
    line = bytearray(VALUE[1] if isinstance(VALUE[1], bytes) else b"")
    line[at] = 0
    with connected((b"\x02", bytes(line)), budget_s=0.0) as scale, pytest.raises(GarbledReply):
        scale.read_mm()


def test_a_readout_that_echoes_is_named() -> None:
    with (
        connected((b"\x02", b"\x02+  121.9750    \r\n"), budget_s=0.0) as scale,
        pytest.raises(GarbledReply, match=r"sends back what it is sent \(echo\)"),
    ):
        scale.read_mm()


def test_a_connection_that_fell_silent_is_replaced() -> None:
    with TcpEnd([*CONNECT, (b"\x02", SILENCE), NEW_CONNECTION, OPENED, IDENTITY, VALUE]) as end:
        scale = HeidenhainND(f"socket://127.0.0.1:{end.port}", timeout_s=0.2)
        scale.connect()
        assert scale.read_mm() == 121.975
        scale.close()


def test_a_truncated_line_is_an_error() -> None:
    cut = (b"\x02", b"+  121.97")
    with connected(cut, budget_s=0.0) as scale, pytest.raises(GarbledReply):
        scale.read_mm()


def test_two_lines_where_one_was_asked_for_are_an_error() -> None:
    double = (b"\x02", VALUE[1] + b"+  122.0000    \r\n")
    with connected(double, IDENTITY, VALUE) as scale:
        assert scale.read_mm() == 121.975


def test_silence_is_a_lost_link() -> None:
    with (
        connected((b"\x02", SILENCE), budget_s=0.0) as scale,
        pytest.raises(LinkLost, match="does not answer"),
    ):
        scale.read_mm()


def test_a_late_line_is_never_taken_for_the_next_one() -> None:
    """The first answer comes after the time-out; the second reading must not get it."""
    late = (b"\x02", Say(b"+  111.1111    \r\n", after_s=0.3))
    with connected(late, IDENTITY, (b"\x02", b"+  222.2222    \r\n"), timeout_s=0.2) as scale:
        assert scale.read_mm() == 222.2222


def test_a_refused_command_is_named() -> None:
    with PtyEnd([OPENED, IDENTITY, INDICATORS, VALUE, (b"\x1bA0200\r", b"\x15")]) as end:
        scale = HeidenhainND(f"serial://{end.port}?override=8N1", timeout_s=0.3)
        with pytest.raises(DeviceFault, match="refuses A0200; is it an ND 280, 281B or 287"):
            scale.connect()


def test_a_model_without_indicators() -> None:
    with connected((b"\x1bA0900\r", b"\x15")) as scale:
        assert scale.indicators() == {}


def test_connect_refuses_values_that_disagree() -> None:
    odd = (b"\x1bA0200\r", b"\x02+012197500\r\n")
    with PtyEnd([OPENED, IDENTITY, INDICATORS, VALUE, odd]) as end:
        scale = HeidenhainND(f"serial://{end.port}?override=8N1", timeout_s=0.3, budget_s=0.0)
        with pytest.raises(GarbledReply, match=r"printed 121\.9750 mm but shows 1219\.7500 mm"):
            scale.connect()


def test_connect_refuses_inches() -> None:
    with PtyEnd([OPENED, IDENTITY, (b"\x1bA0900\r", b"\x021100001000\r\n")]) as end:
        scale = HeidenhainND(f"serial://{end.port}?override=8N1", timeout_s=0.3)
        with pytest.raises(DeviceFault, match="inches"):
            scale.connect()


def test_parity_on_a_pseudo_terminal_needs_the_override() -> None:
    with PtyEnd([]) as end:
        scale = HeidenhainND(f"serial://{end.port}?baud=9600&format=7E2")
        for _ in range(2):  # the system says it differently the second time
            with pytest.raises(DeviceError, match=r"cannot carry 7E2 .* add override=8N1 to its URL"):
                scale.connect()


def test_the_override_is_told() -> None:
    with PtyEnd([]) as end:
        scale = HeidenhainND(f"serial://{end.port}?format=7E2&override=8N1")
    assert scale.line.notice == f"{end.port} runs as 8N1 instead of 7E2, as its URL asks."


def test_a_missing_port_is_a_lost_link() -> None:
    with pytest.raises(LinkLost, match="there is no such port"):
        HeidenhainND("serial:///dev/nowhere").connect()


def test_a_port_that_is_held_is_a_lost_link() -> None:
    with connected() as scale:
        second = HeidenhainND(scale_url(scale))
        with pytest.raises(LinkLost, match="another program holds it"):
            second.connect()


def scale_url(scale: HeidenhainND) -> str:
    assert scale.line.notice is not None
    return f"serial://{scale.line.notice.split()[0]}?override=8N1"


def test_reading_before_connect_and_closing_twice() -> None:
    scale = HeidenhainND("serial:///dev/nowhere")
    with pytest.raises(DeviceError, match="is not open; connect first"):
        scale.read_mm()
    scale.make_safe()
    scale.close()
    scale.close()


def test_pulling_the_cable_is_a_lost_link() -> None:
    with PtyEnd(CONNECT) as end:
        scale = HeidenhainND(f"serial://{end.port}?override=8N1", timeout_s=0.3)
        scale.connect()
    with pytest.raises(LinkLost):
        scale.read_mm()
    scale.close()


@given(st.binary(max_size=40))
@example(b"+  121.9750    \n\n")
@example(b"+  121.9750   \xb1\r\n")
def test_no_other_line_becomes_a_number(line: bytes) -> None:
    """Whatever the bytes, the parser answers a finite number from a perfect line, or refuses."""
    scale = HeidenhainND("serial:///dev/nowhere")
    try:
        value_mm = scale._value_mm(line)
    except DeviceError:
        return
    assert len(line) == 17 and abs(value_mm) < 1e9


def test_a_late_reply_to_another_question_is_no_echo() -> None:
    """It begins with the very character that asks for a value."""
    with (
        connected((b"\x02", b"\x02ND281B    \r\n"), budget_s=0.0) as scale,
        pytest.raises(GarbledReply, match="not a reply it may give"),
    ):
        scale.read_mm()
