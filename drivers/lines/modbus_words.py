"""Modbus frames in words, for readers of a wire log."""

from __future__ import annotations

import struct
from collections.abc import Mapping

from drivers.lines.modbus_frames import READ, with_check_sum

_WRITE_ONE, _WRITE = 0x06, 0x10
_EXCEPTION = 0x80
_HEADER_BYTES = 7


class ModbusWords:
    """Follows one line: the answer to a read contains no register address, but the request before it does."""

    def __init__(self, registers: Mapping[int, str], *, over_tcp: bool) -> None:
        """:param registers: names by address"""
        self._registers = registers
        self._over_tcp = over_tcp
        self._asked = 0

    def request(self, frame: bytes) -> str:
        """The meaning of sent bytes."""
        unit, pdu = self.taken_apart(frame)
        if pdu is None or len(pdu) < 5:
            return _bytes(frame)
        function, address, count = struct.unpack_from(">BHH", pdu)
        self._asked = address
        match function:
            case 0x03:
                return f"drive {unit}: read {self._span(address, count)}"
            case 0x06:
                return f"drive {unit}: write {self._value(address, count)}"
            case 0x10:
                return f"drive {unit}: write {self._values(address, pdu[6:])}"
        return f"drive {unit}: function {function:02X}h, {pdu[1:].hex(' ')}"

    def answer(self, frame: bytes) -> str:
        """The meaning of received bytes: one chunk, which need not be a whole frame."""
        unit, pdu = self.taken_apart(frame)
        if pdu is None or len(pdu) < 2:
            return _bytes(frame)
        if pdu[0] & _EXCEPTION:
            return f"drive {unit}: refuses with exception {pdu[1]:02X}"
        if pdu[0] == READ:
            return f"drive {unit}: {self._values(self._asked, pdu[2:])}"
        if pdu[0] in (_WRITE_ONE, _WRITE):
            return f"drive {unit}: done"
        return f"drive {unit}: function {pdu[0]:02X}h, {pdu[1:].hex(' ')}"

    def taken_apart(self, frame: bytes) -> tuple[int, bytes | None]:
        """The drive and the content of the frame, from the function on; None if it is not a whole frame."""
        if self._over_tcp:
            if len(frame) <= _HEADER_BYTES:
                return 0, None
            return frame[_HEADER_BYTES - 1], frame[_HEADER_BYTES:]
        if len(frame) < 5 or with_check_sum(frame[:-2]) != frame:
            return 0, None
        return frame[0], frame[1:-2]

    def _span(self, address: int, count: int) -> str:
        return self._name(address) + (f" and {count - 1} more" if count > 1 else "")

    def name(self, address: int) -> str:
        """Name of a register, otherwise its address."""
        return self._registers.get(address, f"{address:04X}h")

    def _name(self, address: int) -> str:
        name = self._registers.get(address, "")
        return f"{address:04X}h" + (f" {name}" if name else "")

    def _value(self, address: int, value: int) -> str:
        return f"{self._name(address)} = {value} ({value:04X}h)"

    def _values(self, address: int, data: bytes) -> str:
        words = struct.unpack(f">{len(data) // 2}H", data[: len(data) // 2 * 2])
        if len(words) == 1:
            return self._value(address, words[0])
        if len(words) == 2:
            (value,) = struct.unpack(">i", data[:4])
            return f"{self._name(address)} = {value}"
        return f"{self._name(address)} on = {data.hex(' ', 2)}"


def _bytes(frame: bytes) -> str:
    return f"bytes {frame.hex(' ')}"
