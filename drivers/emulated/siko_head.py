"""The device side of a SIKO reading head with SIKONETZ3, telegram by telegram."""

from __future__ import annotations

import time
from collections.abc import Callable

from drivers.emulated.faults import Faults
from drivers.emulated.machine import Unreachable
from drivers.emulated.readout import Reply

_READ_POSITION, _IDENTIFY, _READ_RESOLUTION = 0x16, 0x1B, 0x1E
_WRONG_CHECK, _REFUSED = 0x82, 0x83
_SHORT = 0x80
_GAP_S = 0.01
"""After a longer pause within a telegram the head discards its beginning."""
_MSA510 = 23
_CODES = {0.1: 2, 0.01: 3}
_INCH_COUNTS = 1 / 2.54
"""Counts of a head that is switched to 0.001 inch: 0.01 mm and 0.001 inch, 0.0254 mm."""


class SikoDevice:
    """One head, address 1.

    :param head_mm: its position on the tape, called once for each value
    """

    def __init__(
        self,
        head_mm: Callable[[], float],
        faults: Faults,
        resolution_mm: float = 0.01,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._head_mm = head_mm
        self._faults = faults
        self._resolution_mm = resolution_mm
        self._clock = clock
        self._address = 1
        self._datum_mm = 0.0
        self._input = b""
        self._heard_s = 0.0

    def receive(self, data: bytes) -> list[Reply]:
        """The head's answer to `data`."""
        if self._clock() - self._heard_s > _GAP_S:
            self._input = b""
        self._heard_s = self._clock()
        self._input += data
        replies = []
        while len(self._input) >= 3:
            telegram, self._input = self._input[:3], self._input[3:]
            reply = self._answer(telegram)
            if reply is not None:
                replies.append(reply)
        return replies

    def shift(self, by_mm: float) -> None:
        """Increase every value from now on."""
        self._datum_mm -= by_mm

    def reboot(self) -> None:
        """An absolute head retains its position; only a shift is lost."""
        self._datum_mm = 0.0

    def is_value(self, data: bytes) -> bool:
        """Whether these bytes are a position."""
        return len(data) == 6 and data[1] == _READ_POSITION

    def marked_faulty(self, data: bytes) -> bytes:
        """The output in place of a position where the head cannot measure."""
        return self._telegram(bytes((self._address, _REFUSED)))

    def in_other_unit(self, data: bytes) -> bytes:
        """A position of the same head when it counts in inches."""
        counts = round(int.from_bytes(data[2:5], "little", signed=True) * _INCH_COUNTS)
        return self._telegram(data[:2] + counts.to_bytes(3, "little", signed=True))

    def _answer(self, telegram: bytes) -> Reply | None:
        if telegram[0] & ~_SHORT != self._address or not telegram[0] & _SHORT:
            return None
        if self._telegram(telegram[:2]) != telegram:
            return Reply(self._telegram(bytes((self._address, _WRONG_CHECK))))
        command = telegram[1]
        if command == _IDENTIFY:
            return self._long(command, bytes((_MSA510, 3, 1)))
        if command == _READ_RESOLUTION and self._resolution_mm in _CODES:
            return self._long(command, bytes((_CODES[self._resolution_mm], 0, 0)))
        if command == _READ_POSITION:
            return self._position()
        return Reply(self._telegram(bytes((self._address, _REFUSED))))

    def _position(self) -> Reply | None:
        if self._faults.due("scale_silent"):
            return None
        try:
            value_mm = self._head_mm() - self._datum_mm
        except Unreachable:
            return Reply(self.marked_faulty(b""))
        if self._faults.due("scale_fault_mark"):
            return Reply(self.marked_faulty(b""))
        counts = round(value_mm / self._resolution_mm)
        reply = self._long(_READ_POSITION, counts.to_bytes(3, "little", signed=True))
        if self._faults.due("scale_garbled"):
            reply = Reply(reply.data[:2] + bytes((reply.data[2] ^ 0x10,)) + reply.data[3:])
        late = self._faults.due("scale_late")
        return Reply(reply.data, late.delay_s if late else 0.0)

    def _long(self, command: int, data: bytes) -> Reply:
        return Reply(self._telegram(bytes((self._address, command)) + data))

    @staticmethod
    def _telegram(start: bytes) -> bytes:
        check = 0
        for byte in start:
            check ^= byte
        return start + bytes((check,))
