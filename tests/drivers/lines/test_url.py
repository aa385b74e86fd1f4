"""URLs of the station file: what is read, and the sentence for what is not."""

from __future__ import annotations

import pytest

from drivers.errors import DeviceError
from drivers.lines.url import BadUrl, LineFormat, NetAddress, SerialAddress, parse_line_url


def parse(url: str) -> SerialAddress | NetAddress:
    return parse_line_url(url, serial="serial", net=("socket",), default_baud=9600, default_format="7E2")


def test_serial_port_with_its_settings() -> None:
    address = parse("serial:///dev/ttyUSB0?baud=38400&format=8N1")
    assert address == SerialAddress("/dev/ttyUSB0", 38400, LineFormat(8, "N", 1), None)


def test_defaults_are_the_devices() -> None:
    address = parse("serial:///dev/ttyUSB0")
    assert address == SerialAddress("/dev/ttyUSB0", 9600, LineFormat(7, "E", 2), None)
    assert LineFormat(7, "E", 2).bits_per_byte == 11


def test_override_is_used_and_told() -> None:
    address = parse("serial:///dev/pts/3?format=7E2&override=8N1")
    assert isinstance(address, SerialAddress)
    assert str(address.effective_format) == "8N1"
    assert address.notice == "/dev/pts/3 runs as 8N1 instead of 7E2, as its URL asks."


def test_network_address() -> None:
    assert parse("socket://10.0.0.7:4001") == NetAddress("10.0.0.7", 4001)


@pytest.mark.parametrize(
    ("url", "complaint"),
    [
        ("/dev/ttyUSB0", "must begin with serial:// or socket://"),
        ("serial://ttyUSB0", "three slashes"),
        ("serial:///", "three slashes"),
        ("serial:///dev/ttyUSB0?speed=9600", 'unknown setting "speed"'),
        ("serial:///dev/ttyUSB0?baud=fast", 'baud rate "fast"'),
        ("serial:///dev/ttyUSB0?format=9X3", 'line format "9X3"'),
        ("serial:///dev/ttyUSB0?override=", 'line format ""'),
        ("socket://10.0.0.7", "must be socket://host:port"),
        ("socket://10.0.0.7:99999", "must be socket://host:port"),
        ("socket://10.0.0.7:4001/x", "must be socket://host:port"),
    ],
)
def test_refused_in_one_sentence(url: str, complaint: str) -> None:
    with pytest.raises(BadUrl, match=complaint) as caught:
        parse(url)
    text = str(caught.value)
    assert text.endswith(".") and "\n" not in text
    assert isinstance(caught.value, DeviceError) and isinstance(caught.value, ValueError)
