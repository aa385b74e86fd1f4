"""The reading head's driver against literal telegrams of the maker."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.protocols import LinearScale
from drivers.scales.siko import SikoHead, SikoSettings, with_check_byte
from tests.drivers.wire import NEW_CONNECTION, SILENCE, Exchange, PtyEnd, Say, TcpEnd

ASK = bytes.fromhex("87 16 91")
POSITION = bytes.fromhex("07 16 03 02 00 10")
VALUE: Exchange = (ASK, POSITION)
IDENTITY: Exchange = (bytes.fromhex("87 1B 9C"), with_check_byte(bytes.fromhex("07 1B 22 01 01")))
CONNECT: list[Exchange] = [IDENTITY, VALUE, VALUE]


def at(counts: int) -> Exchange:
    """The exchange in which the head stands at so many counts."""
    return ASK, position(counts)


def position(counts: int) -> bytes:
    """The reply to it."""
    return with_check_byte(b"\x07\x16" + counts.to_bytes(3, "little", signed=True))


@contextmanager
def connected(*exchanges: Exchange, budget_s: float | None = None, **options: float) -> Iterator[SikoHead]:
    """A head with address 7 that has connected and has `exchanges` before it."""
    with PtyEnd([*CONNECT, *exchanges]) as end:
        settings = SikoSettings.model_validate(
            {"url": f"serial://{end.port}", "address": 7, "timeout_s": 0.3, **options}
        )
        head = SikoHead(settings, budget_s=budget_s)
        head.connect()
        try:
            yield head
        finally:
            head.close()


def test_the_makers_worked_telegram() -> None:
    """515 counts at address 7."""
    with connected(VALUE, VALUE) as head:
        assert isinstance(head, LinearScale)
        assert head.identity == "MSA501, firmware 1"
        assert head.read_mm() == pytest.approx(5.15)


def test_positions_are_signed_and_have_the_resolution_of_the_head() -> None:
    with connected(at(-1), at(-1), at(-8388608), at(-8388608), resolution_mm=0.005) as head:
        assert head.read_mm() == pytest.approx(-0.005)
        assert head.read_mm() == pytest.approx(-41943.04)


def test_two_flipped_bits_that_the_check_byte_misses_are_never_a_value() -> None:
    with connected(at(515 ^ 0x4040), VALUE, VALUE) as head:
        assert head.read_mm() == pytest.approx(5.15)


@pytest.mark.parametrize(
    ("counts", "value_mm"),
    [
        ((515, 615, 715), 6.15),
        ((715, 615, 515), 6.15),
        ((515, 615, 1615), 6.15),  # the program was delayed between two reads
        ((515, 1515, 1615), 15.15),
        # a damaged reply may be one of the three, but not the one in the middle
        ((9999, 515, 615, 715), 6.15),
        ((515, 9999, 615, 715, 815), 7.15),
        ((515, 615, 9999), 6.15),
    ],
)
def test_a_moving_head_is_at_a_position_between_two_others(counts: tuple[int, ...], value_mm: float) -> None:
    with connected(*map(at, counts)) as head:
        assert head.read_mm() == pytest.approx(value_mm)


def test_values_that_agree_with_nothing_are_refused() -> None:
    with (
        connected(at(0), at(5000), at(0), at(7000), at(0)) as head,
        pytest.raises(GarbledReply, match="5000"),
    ):
        head.read_mm()


@pytest.mark.parametrize("lead", ["07", "87"])
def test_a_head_that_cannot_measure_says_why(lead: str) -> None:
    error = with_check_byte(bytes.fromhex(f"{lead} 83"))
    with connected((ASK, error)) as head, pytest.raises(DeviceFault, match="gap to the tape is too large"):
        head.read_mm()


@pytest.mark.parametrize(
    "bad",
    [
        with_check_byte(bytes.fromhex("07 82")),
        POSITION[:-1] + b"\x11",
        POSITION[:4],
        b"\x00" + POSITION,
        POSITION + POSITION,
        with_check_byte(bytes.fromhex("08 16 03 02 00")),
        with_check_byte(bytes.fromhex("07 18 03 02 00")),
        SILENCE,
    ],
)
def test_a_bad_reply_is_asked_for_again(bad: bytes) -> None:
    with connected((ASK, bad), VALUE, VALUE) as head:
        assert head.read_mm() == pytest.approx(5.15)


def test_a_late_reply_is_not_taken_for_the_next() -> None:
    with connected((ASK, Say(position(9999), after_s=0.115)), VALUE, VALUE) as head:
        assert head.read_mm() == pytest.approx(5.15)


def test_silence_is_a_lost_link() -> None:
    with connected((ASK, SILENCE), budget_s=0.0) as head, pytest.raises(LinkLost, match="does not answer"):
        head.read_mm()


def test_an_adapter_that_echoes_is_named() -> None:
    with connected((ASK, ASK + POSITION), budget_s=0.0) as head, pytest.raises(GarbledReply, match="echo"):
        head.read_mm()


def test_an_adapter_that_echoes_is_used_as_its_address_says() -> None:
    echoing: list[Exchange] = [(ask, ask + bytes(answer)) for ask, answer in CONNECT]  # type: ignore[arg-type]
    with PtyEnd(echoing) as end:
        head = SikoHead(SikoSettings(url=f"serial://{end.port}?echo=1", address=7))
        head.connect()
        head.close()


@pytest.mark.parametrize(("code", "says"), [(2, "counts in 0.1 mm"), (4, "counts in inches")])
def test_a_resolution_that_is_not_as_configured_is_refused(code: int, says: str) -> None:
    identity = (IDENTITY[0], with_check_byte(bytes.fromhex("07 1B 17 01 01")))
    resolution = (with_check_byte(b"\x87\x1e"), with_check_byte(bytes((7, 0x1E, code, 0, 0))))
    with PtyEnd([identity, resolution]) as end:
        head = SikoHead(SikoSettings(url=f"serial://{end.port}", address=7))
        with pytest.raises(DeviceFault, match=says):
            head.connect()


def test_another_device_on_the_line_is_no_head() -> None:
    refused = (IDENTITY[0], with_check_byte(bytes.fromhex("07 83")))
    with PtyEnd([refused]) as end:
        head = SikoHead(SikoSettings(url=f"serial://{end.port}", address=7))
        with pytest.raises(DeviceError, match=r"refuses command 1Bh \(error 83h\)"):
            head.connect()


def test_a_device_server_that_fell_silent_is_connected_anew() -> None:
    with TcpEnd([*CONNECT, (ASK, SILENCE), NEW_CONNECTION, VALUE, VALUE]) as end:
        head = SikoHead(SikoSettings(url=f"socket://127.0.0.1:{end.port}", address=7))
        head.connect()
        assert head.read_mm() == pytest.approx(5.15)
        head.close()
