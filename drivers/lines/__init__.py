"""Lines: serial ports, Modbus connections, and the URLs that name them."""

from __future__ import annotations

from drivers.lines.modbus import ModbusBus, UnansweredWrite
from drivers.lines.on_line import OnLine
from drivers.lines.retrying import within
from drivers.lines.serial import SerialLine

__all__ = [
    "ModbusBus",
    "OnLine",
    "SerialLine",
    "UnansweredWrite",
    "within",
]
