"""The device side of a Heidenhain ND 281B position display, byte by byte.

It answers Ctrl-B with the measured-value line, Ctrl-E with the error message, and `ESC Tnnnn CR` (keys), `ESC
Annnn CR` (screen), `ESC Fnnnn CR` (functions) and `ESC Snnnn CR` (special) as in the maker's tables. It is
independent of the transport: bytes come in, replies with their delay go out.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from drivers.emulated.faults import Faults
from drivers.emulated.machine import Unreachable
from drivers.emulated.readout import Reply

_STX, _ENQ, _ACK, _NAK, _ESC = b"\x02", b"\x05", b"\x06", b"\x15", b"\x1b"
_LONGEST_COMMAND_BYTES = 7
_STEP_MM = 1e-4
_ERROR_TEXT = "FORMAT ERR."
_KEY_CL, _KEY_MINUS, _KEY_POINT, _KEY_ENT = 100, 101, 102, 104
_MOST_DIGITS = 9
_VALUE = re.compile(rb"[+-][ 0-9.]{10} .. \r\n|[+-][ 0-9.]{10} ...\r\n")
_UNIT_AT = 12


class ND280:
    """One display on its head.

    :param head_mm: the head's position, called once for each value
    """

    def __init__(self, head_mm: Callable[[], float], faults: Faults) -> None:
        self._head_mm = head_mm
        self._faults = faults
        self._input = b""
        self._datum_mm = 0.0
        self._typed = ""
        self._locked = False
        self._error: str | None = None

    def receive(self, data: bytes) -> list[Reply]:
        """The display's answer to `data`."""
        self._input += data
        replies = []
        while request := self._next_request():
            reply = self._answer(request)
            if reply is not None:
                replies.append(reply)
        return replies

    def shift(self, by_mm: float) -> None:
        """Increase every value from now on, as after a miscount."""
        self._datum_mm -= by_mm

    def reboot(self) -> None:
        """Simulate a power failure: the datum is lost."""
        self._special(0)

    def is_value(self, data: bytes) -> bool:
        """Whether these bytes are a measured-value line."""
        return _VALUE.fullmatch(data) is not None

    def marked_faulty(self, data: bytes) -> bytes:
        """A value line with a fault mark."""
        return data[:_UNIT_AT] + b"?" + data[_UNIT_AT + 1 :]

    def in_other_unit(self, data: bytes) -> bytes:
        """A value line in inches."""
        return data[:_UNIT_AT] + b'"' + data[_UNIT_AT + 1 :]

    def _next_request(self) -> bytes:
        """One complete request from the input buffer, or nothing yet."""
        while self._input:
            first = self._input[:1]
            if first != _ESC:
                self._input = self._input[1:]
                if first in (_STX, _ENQ):
                    return first
                continue  # not part of any request
            end = self._input.find(b"\r")
            if end < 0 and len(self._input) <= _LONGEST_COMMAND_BYTES:
                return b""
            length = end + 1 if 0 <= end <= _LONGEST_COMMAND_BYTES else _LONGEST_COMMAND_BYTES
            request, self._input = self._input[:length], self._input[length:]
            return request
        return b""

    def _answer(self, request: bytes) -> Reply | None:
        if request == _STX:
            return self._measured_value()
        if request == _ENQ:
            return Reply(f"{self._error or '':13.13}\r\n".encode("ascii"))
        match = re.fullmatch(rb"\x1b([TAFS])(\d{4})\r", request)
        if match is None:
            return Reply(_NAK)
        letter, number = match[1], int(match[2])
        if letter == b"A":
            try:
                text = self._screen(number)
            except Unreachable:
                text = None
            return Reply(_NAK if text is None else _STX + text.encode("ascii"))
        if letter == b"F" and number == 200:
            line = self._measured_value()
            return None if line is None else Reply(_ACK + line.data, line.delay_s)
        known = self._press(number) if letter == b"T" else letter == b"S" and self._special(number)
        return Reply(_ACK if known else _NAK)

    def _measured_value(self) -> Reply | None:
        """The 17 characters of the measured-value output."""
        if self._faults.due("scale_silent"):
            return None
        fault_mark = self._faults.due("scale_fault_mark") is not None
        try:
            value_mm = self._value_mm()
        except Unreachable:  # impossible arm angles for the slider: the head is off its scale
            value_mm, fault_mark = 0.0, True
        self._error = _ERROR_TEXT if fault_mark else None
        unit = "?" if fault_mark else " "
        line = f"{'-' if value_mm < 0 else '+'}{abs(value_mm):10.4f} {unit}  \r\n".encode("ascii")
        if self._faults.due("scale_garbled"):
            line = line[:4] + line[5:9] + b"#" + line[9:]
        late = self._faults.due("scale_late")
        return Reply(line, late.delay_s if late else 0.0)

    def _screen(self, number: int) -> str | None:
        """Text of a screen output, None if there is none."""
        match number:
            case 0:
                return "ND281B    \r\n 349797-03\r\n          \r\n"
            case 100:
                return f"{self._value_mm():+.4f}\r\n" if self._error is None else f"{self._error:13}\r\n"
            case 200:
                return f"{round(self._value_mm() / _STEP_MM):+010d}\r\n"
            case 301:
                return f"{self._error:13}\r\n" if self._error is not None else None
            case 400:
                return " 349797-03\r\n"
            case 900:
                return "11000000000000\r\n"
        return None

    def _press(self, key: int) -> bool:
        """A key of the front panel: digits, CL, minus, point, ENT (which sets the datum)."""
        if not (0 <= key <= 9 or key in (_KEY_CL, _KEY_MINUS, _KEY_POINT, _KEY_ENT)):
            return False
        if self._locked:
            return True
        if key == _KEY_CL:
            self._typed = ""
            self._error = None
        elif key == _KEY_MINUS:
            self._typed = self._typed[1:] if self._typed.startswith("-") else "-" + self._typed
        elif key == _KEY_ENT:
            self._set_datum()
        elif len(self._typed) < _MOST_DIGITS:
            self._typed += "." if key == _KEY_POINT else str(key)
        return True

    def _set_datum(self) -> None:
        if re.fullmatch(r"-?(\d+\.?\d*|\.\d+)", self._typed):
            self._datum_mm = self._head_mm() - float(self._typed)
        self._typed = ""

    def _special(self, number: int) -> bool:
        if number == 0:
            self._datum_mm, self._typed, self._error, self._locked = 0.0, "", None, False
        elif number in (1, 2):
            self._locked = number == 1
        return number in (0, 1, 2)

    def _value_mm(self) -> float:
        return round((self._head_mm() - self._datum_mm) / _STEP_MM) * _STEP_MM
