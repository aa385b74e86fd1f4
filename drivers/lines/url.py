"""Where a device hangs: the URLs of the station file, read strictly.

`serial:///dev/ttyUSB0?baud=9600&format=7E2`, `socket://host:port`,
`modbus+rtu:///dev/ttyUSB1?baud=38400&format=8N2`, `modbus+tcp://host:port`.

`override=8N1` may follow on a serial URL: the line is then opened with that format instead,
for a port that cannot carry the wanted one (a pseudo-terminal has no parity), and the opened
line says so in its `notice`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import SplitResult, parse_qsl, urlsplit

from drivers.errors import DeviceError


class BadUrl(DeviceError, ValueError):
    """A URL of the station file that cannot be used; the text is one sentence."""


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
        """On the wire, start bit included."""
        return 1 + self.data_bits + (self.parity != "N") + self.stop_bits


@dataclass(frozen=True, slots=True)
class SerialAddress:
    """A serial port with its line settings."""

    port: str
    baud: int
    format: LineFormat
    override: LineFormat | None

    def __str__(self) -> str:
        return self.port

    @property
    def effective_format(self) -> LineFormat:
        """What the port is opened with."""
        return self.override or self.format

    @property
    def notice(self) -> str | None:
        """One sentence for the log when the wanted format is overridden."""
        if self.override is None or self.override == self.format:
            return None
        return f"{self.port} runs as {self.override} instead of {self.format}, as its URL asks."


@dataclass(frozen=True, slots=True)
class NetAddress:
    """A host and TCP port."""

    host: str
    port: int

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"


def parse_line_url(
    url: str, *, serial: str, net: str, default_baud: int, default_format: str
) -> SerialAddress | NetAddress:
    """A serial or network address out of `url`.

    :param serial: scheme of the serial form, for instance "serial"
    :param net: scheme of the network form, for instance "socket"
    :raises BadUrl: with what is wrong in it
    """
    parts = urlsplit(url)
    if parts.scheme == serial:
        return _serial_address(url, parts, default_baud, default_format)
    if parts.scheme == net:
        return _net_address(url, parts)
    raise BadUrl(f'The address "{url}" must begin with {serial}:// or {net}://.')


def _serial_address(url: str, parts: SplitResult, default_baud: int, default_format: str) -> SerialAddress:
    if parts.netloc or not parts.path.strip("/"):
        raise BadUrl(
            f'The address "{url}" must name a port after three slashes, as in {parts.scheme}:///dev/ttyUSB0.'
        )
    options = dict(parse_qsl(parts.query, keep_blank_values=True))
    unknown = sorted(options.keys() - {"baud", "format", "override"})
    if unknown:
        raise BadUrl(
            f'The address "{url}" has the unknown setting "{unknown[0]}"; baud, format and override exist.'
        )
    baud_text = options.get("baud", str(default_baud))
    if not re.fullmatch(r"[1-9]\d{2,6}", baud_text):
        raise BadUrl(
            f'The address "{url}" has the baud rate "{baud_text}", which is not a whole number such as 9600.'
        )
    override = options.get("override")
    return SerialAddress(
        port=parts.path,
        baud=int(baud_text),
        format=_line_format(url, options.get("format", default_format)),
        override=None if override is None else _line_format(url, override),
    )


def _line_format(url: str, text: str) -> LineFormat:
    if not re.fullmatch(r"[78][NEO][12]", text):
        raise BadUrl(f'The address "{url}" has the line format "{text}", which is not one like 8N1 or 7E2.')
    return LineFormat(int(text[0]), text[1], int(text[2]))


def _net_address(url: str, parts: SplitResult) -> NetAddress:
    try:
        port = parts.port
    except ValueError:
        port = None
    if not parts.hostname or not port or parts.path.strip("/") or parts.query:
        raise BadUrl(f'The address "{url}" must be {parts.scheme}://host:port and nothing more.')
    return NetAddress(parts.hostname, port)
