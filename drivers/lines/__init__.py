"""Lines: serial ports, Modbus connections, and the URLs that name them."""

from __future__ import annotations

from drivers.lines.modbus import ModbusBus, UnansweredWrite
from drivers.lines.retrying import within
from drivers.lines.serial import SerialLine, Trace

__all__ = [
    "ModbusBus",
    "SerialLine",
    "Trace",
    "UnansweredWrite",
    "within",
]
