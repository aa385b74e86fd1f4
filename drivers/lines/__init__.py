"""Lines: serial ports, Modbus connections, and the URLs that name them."""

from __future__ import annotations

from drivers.lines.modbus import ModbusBus, UnansweredWrite
from drivers.lines.on_line import OnLine, line_of
from drivers.lines.retrying import within
from drivers.lines.serial import Happening, SerialLine
from drivers.lines.url import NetAddress, SerialAddress

__all__ = [
    "Happening",
    "ModbusBus",
    "NetAddress",
    "OnLine",
    "SerialAddress",
    "SerialLine",
    "UnansweredWrite",
    "line_of",
    "within",
]
