"""Lines: serial ports, Modbus connections, and the URLs that name them."""

from __future__ import annotations

from drivers.lines.modbus import ModbusBus, UnansweredWrite
from drivers.lines.modbus_words import ModbusWords
from drivers.lines.on_line import OnLine, line_of
from drivers.lines.playback import Departed, Playback
from drivers.lines.ports import Port, open_port
from drivers.lines.retrying import within
from drivers.lines.serial import XON, Happening, SerialLine
from drivers.lines.traffic import Traffic
from drivers.lines.url import NetAddress, SerialAddress
from drivers.lines.wire_log import WireEvent, WireLog, wire_events

__all__ = [
    "XON",
    "Departed",
    "Happening",
    "ModbusBus",
    "ModbusWords",
    "NetAddress",
    "OnLine",
    "Playback",
    "Port",
    "SerialAddress",
    "SerialLine",
    "Traffic",
    "UnansweredWrite",
    "WireEvent",
    "WireLog",
    "line_of",
    "open_port",
    "wire_events",
    "within",
]
