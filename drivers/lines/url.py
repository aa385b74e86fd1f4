"""Addresses of devices: the URLs of the station file, parsed strictly.

`serial:///dev/ttyUSB0?baud=9600&format=7E2`, `socket://host:port`,
`modbus+rtu:///dev/ttyUSB1?baud=38400&format=8N2`, `modbus+tcp://host:port`, `modbus+rtuovertcp://host:port`
(RTU frames through a serial device server), `rfc2217://host:port?baud=9600& format=7E2` and
`modbus+rfc2217://...` (a device server that accepts the line settings as well).

`override=8N1` may follow on a serial URL: the line is then opened with that format instead, for a port that
does not support the specified one (a pseudo-terminal has no parity), and the opened line reports it in its
`notice`. `echo=1` states that the RS-485 adapter echoes everything it receives.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from urllib.parse import SplitResult, parse_qsl, urlsplit

from drivers.errors import DeviceError


class BadUrl(DeviceError, ValueError):
    """A URL of the station file is unusable; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class LineFormat:
    """Data bits, parity and stop bits, written like 7E2."""

    data_bits: int
    parity: str
    stop_bits: int

    def __str__(self) -> str:
        return f"{self.data_bits}{self.parity}{self.stop_bits}"

    @property
    def bits_per_byte(self) -> int:
        """Number of bits on the wire, start bit included."""
        return 1 + self.data_bits + (self.parity != "N") + self.stop_bits


@dataclass(frozen=True, slots=True)
class SerialAddress:
    """A serial port with its line settings."""

    port: str
    baud: int
    format: LineFormat
    override: LineFormat | None
    echo: bool = False
    """Whether the adapter echoes."""

    def __str__(self) -> str:
        return self.port

    @property
    def effective_format(self) -> LineFormat:
        """Format with which the port is opened."""
        return self.override or self.format

    @property
    def notice(self) -> str | None:
        """One sentence for the log if the specified format is overridden."""
        if self.override is None or self.override == self.format:
            return None
        return f"{self.port} runs as {self.override} instead of {self.format}, as its URL asks."


@dataclass(frozen=True, slots=True)
class NetAddress:
    """A host and TCP port."""

    host: str
    port: int
    echo: bool = False
    """Whether the far adapter echoes."""

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"


@dataclass(frozen=True, slots=True)
class RemoteSerialAddress(NetAddress):
    """A serial port of a device server, with its line settings."""

    baud: int = 9600
    format: LineFormat = LineFormat(8, "N", 1)


def parse_line_url(
    url: str, *, serial: str, net: Sequence[str], default_baud: int, default_format: str
) -> SerialAddress | NetAddress:
    """A serial or network address from `url`.

    :param serial: scheme of the serial form, for instance "serial"
    :param net: schemes of the network form, for instance "socket"
    :raises BadUrl: with the error in it
    """
    parts = urlsplit(url)
    if parts.scheme == serial:
        return _serial_address(url, parts, default_baud, default_format)
    if parts.scheme in net:
        address = _net_address(url, parts, ("baud", "format", "echo") if _is_remote(parts) else ("echo",))
        if not _is_remote(parts):
            return address
        options = dict(parse_qsl(parts.query))
        return RemoteSerialAddress(
            address.host,
            address.port,
            address.echo,
            _baud(url, options, default_baud),
            _line_format(url, options.get("format", default_format)),
        )
    *most, last = (f"{scheme}://" for scheme in (serial, *net))
    raise BadUrl(f'The address "{url}" must begin with {", ".join(most)} or {last}.')


def _serial_address(url: str, parts: SplitResult, default_baud: int, default_format: str) -> SerialAddress:
    if parts.netloc or not parts.path.strip("/"):
        raise BadUrl(
            f'The address "{url}" must name a port after three slashes, as in {parts.scheme}:///dev/ttyUSB0.'
        )
    options = _options(url, parts, ("baud", "format", "override", "echo"))
    override = options.get("override")
    return SerialAddress(
        port=parts.path,
        baud=_baud(url, options, default_baud),
        format=_line_format(url, options.get("format", default_format)),
        override=None if override is None else _line_format(url, override),
        echo=_echo(url, options),
    )


def _is_remote(parts: SplitResult) -> bool:
    return parts.scheme.endswith("rfc2217")


def _baud(url: str, options: dict[str, str], default: int) -> int:
    text = options.get("baud", str(default))
    if not re.fullmatch(r"[1-9]\d{2,6}", text):
        raise BadUrl(
            f'The address "{url}" has the baud rate "{text}", which is not a whole number such as 9600.'
        )
    return int(text)


def _options(url: str, parts: SplitResult, known: tuple[str, ...]) -> dict[str, str]:
    options = dict(parse_qsl(parts.query, keep_blank_values=True))
    if unknown := sorted(options.keys() - {*known}):
        *most, last = known
        there_are = f"{', '.join(most)} and {last} exist" if most else f"{last} exists"
        raise BadUrl(f'The address "{url}" has the unknown setting "{unknown[0]}"; {there_are}.')
    return options


def _echo(url: str, options: dict[str, str]) -> bool:
    echo = options.get("echo", "0")
    if echo not in ("0", "1"):
        raise BadUrl(f'The address "{url}" has echo={echo}; 1 is for an adapter that echoes, else 0.')
    return echo == "1"


def _line_format(url: str, text: str) -> LineFormat:
    if not re.fullmatch(r"[78][NEO][12]", text):
        raise BadUrl(f'The address "{url}" has the line format "{text}", which is not one like 8N1 or 7E2.')
    return LineFormat(int(text[0]), text[1], int(text[2]))


def _net_address(url: str, parts: SplitResult, known: tuple[str, ...]) -> NetAddress:
    try:
        port = parts.port
    except ValueError:
        port = None
    if not parts.hostname or not port or parts.path.strip("/"):
        raise BadUrl(f'The address "{url}" must be {parts.scheme}://host:port.')
    return NetAddress(parts.hostname, port, _echo(url, _options(url, parts, known)))
