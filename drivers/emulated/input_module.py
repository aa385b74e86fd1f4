"""A remote input module on the line of the drives: the switch of the guard door, and a thermometer.

Holding register 0: inputs, bit 0 set while the door is closed.  Register 1: temperature, signed, 0.1 degC.
"""

from __future__ import annotations

from drivers.emulated.drive import ILLEGAL_ADDRESS, ILLEGAL_FUNCTION, ILLEGAL_VALUE, exception
from drivers.emulated.machine import Machine

UNIT = 3
"""Its address."""
INPUTS, TEMPERATURE = 0, 1
DOOR_CLOSED = 1 << 0
ROOM_C = 20.0
_READ = 0x03


class InputModule:
    """Answers request PDUs."""

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self.door_open = False
        self.shown_c: float | None = None
        """Displayed in place of the machine's temperature."""

    def answer(self, request: bytes) -> bytes:
        """The reply PDU, an exception included."""
        function = request[0] if request else 0
        if function != _READ:
            return exception(function, ILLEGAL_FUNCTION)
        if len(request) != 5:
            return exception(function, ILLEGAL_VALUE)
        address, count = (int.from_bytes(request[at : at + 2], "big") for at in (1, 3))
        values = (self._inputs(), self._temperature())[address : address + count]
        if count < 1 or len(values) != count:
            return exception(function, ILLEGAL_ADDRESS)
        return bytes((function, 2 * count)) + b"".join(value.to_bytes(2, "big") for value in values)

    def _inputs(self) -> int:
        return 0 if self.door_open else DOOR_CLOSED

    def _temperature(self) -> int:
        shown_c = ROOM_C + self._machine.temperature_rise_k() if self.shown_c is None else self.shown_c
        return round(10 * shown_c) & 0xFFFF
