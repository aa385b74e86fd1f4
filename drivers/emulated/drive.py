"""Common functions of the emulated drives: Modbus functions over registers, a servo axis, and faults."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine
from drivers.emulated.spec import FaultKind

ILLEGAL_FUNCTION, ILLEGAL_ADDRESS, ILLEGAL_VALUE = 0x01, 0x02, 0x03
_READ, _WRITE_ONE, _WRITE = 0x03, 0x06, 0x10
_MOST_READ, _MOST_WRITTEN = 125, 123
_LOST_PULSES = 500


class EmulatedDrive(ABC):
    """Answers request PDUs (function code and data, no address, no check sum)."""

    following_error_alarm: int
    """Code of the family's alarm for a following error."""
    check_sum_exception: int | None = None
    """Exception code of the family for a frame with a wrong check sum; None: no answer."""

    def __init__(self, machine: Machine, joint: int, faults: Faults, registers: dict[int, int]) -> None:
        self._machine = machine
        self._joint: Final = 1 if joint == 1 else 2
        self._axis = machine.axes[joint - 1]
        self._faults = faults
        self._registers = registers
        self._alarm = 0
        self._in_position = True
        self._never_in_position = False
        self.never_in_position = False
        self.frozen = False
        """While true, the feedback does not change."""
        self._frozen_pulses: int | None = None
        self._lost_pulses = 0

    # Faults ---------------------------------------------------------------------------------------

    def raise_alarm(self, code: int = 0) -> None:
        """Stop and show an alarm; 0 is that of a following error."""
        self._machine.quick_stop(self._joint)
        self._alarm = code or self.following_error_alarm

    def lose_counts(self) -> None:
        """Simulate missed pulses of the encoder: from now on its count is shifted."""
        self._axis.zero_pulses += _LOST_PULSES
        self._lost_pulses += _LOST_PULSES

    def reboot(self) -> None:
        """Simulate a power failure: switched off, stopped, and counting from its current position."""
        self._machine.quick_stop(self._joint)
        self._switch_off()
        self._lost_pulses += self._axis.feedback_pulses()
        self._axis.declare_zero()

    def find_reference(self) -> None:
        """Restore lost counts, as after homing."""
        self._axis.zero_pulses -= self._lost_pulses
        self._lost_pulses = 0

    def close(self) -> None:  # noqa: B027 - most run nothing by themselves
        """End all threads of the drive."""

    # Modbus ---------------------------------------------------------------------------------------

    def answer(self, request: bytes) -> bytes:
        """The reply PDU, an exception included."""
        function = request[0] if request else 0
        fault = self._faults.due("drive_exception", self._joint)
        if fault is not None:
            return exception(function, fault.code or ILLEGAL_VALUE)
        if function == _READ:
            return self._read(request)
        if function == _WRITE_ONE:
            return self._write_one(request)
        if function == _WRITE:
            return self._write(request)
        return exception(function, ILLEGAL_FUNCTION)

    def _read(self, request: bytes) -> bytes:
        address, count = _word(request, 1), _word(request, 3)
        if len(request) != 5 or not 1 <= count <= _MOST_READ:
            return exception(_READ, ILLEGAL_VALUE)
        live, kept = self._live(), self._registers
        try:
            values = [live[at] if at in live else kept[at] for at in range(address, address + count)]
        except KeyError:
            return exception(_READ, ILLEGAL_ADDRESS)
        return bytes((_READ, 2 * count)) + b"".join(value.to_bytes(2, "big") for value in values)

    def _write_one(self, request: bytes) -> bytes:
        if len(request) != 5:
            return exception(_WRITE_ONE, ILLEGAL_VALUE)
        code = self._store(_word(request, 1), [_word(request, 3)])
        return exception(_WRITE_ONE, code) if code else request

    def _write(self, request: bytes) -> bytes:
        count = _word(request, 3)
        if not 1 <= count <= _MOST_WRITTEN or len(request) != 6 + 2 * count or request[5] != 2 * count:
            return exception(_WRITE, ILLEGAL_VALUE)
        code = self._store(_word(request, 1), [_word(request, 6 + 2 * i) for i in range(count)])
        return exception(_WRITE, code) if code else request[:5]

    @abstractmethod
    def _store(self, address: int, values: list[int]) -> int:
        """Write registers in order; an exception code or 0."""

    @abstractmethod
    def _live(self) -> dict[int, int]:
        """Registers that contain the drive's state."""

    @abstractmethod
    def _switch_off(self) -> None:
        """Switch off the power stage."""

    # The axis -------------------------------------------------------------------------------------

    def _move(self, target: int, rpm: int, rpm_per_s: float) -> None:
        fault = self._faults.due("drive_alarm", self._joint)
        if fault is not None:
            self._machine.quick_stop(self._joint)
            self._alarm = fault.code or self.following_error_alarm
            return
        kind: FaultKind = "drive_never_in_position"
        self._never_in_position = self._faults.due(kind, self._joint) is not None
        self._machine.command(self._joint, target, rpm, rpm_per_s)
        self._in_position = True

    def _stop(self) -> None:
        self._machine.quick_stop(self._joint)
        self._in_position = False

    def _declare_zero(self) -> int:
        """An exception code or 0."""
        if self._axis.moving:
            return ILLEGAL_VALUE
        self._machine.declare_zero(self._joint)
        self._lost_pulses = 0
        return 0

    @property
    def _arrived(self) -> bool:
        in_position = self._in_position and not (self._never_in_position or self.never_in_position)
        return in_position and not self._axis.moving

    def _feedback_pulses(self) -> int:
        if not self.frozen:
            self._frozen_pulses = None
            return self._axis.feedback_pulses()
        if self._frozen_pulses is None:
            self._frozen_pulses = self._axis.feedback_pulses()
        return self._frozen_pulses


def exception(function: int, code: int) -> bytes:
    """An exception PDU."""
    return bytes((function | 0x80, code))


def signed(high: int, low: int) -> int:
    """Two registers as a signed value."""
    value = high << 16 | low
    return value - (1 << 32) if high & 0x8000 else value


def pair(value: int) -> tuple[int, int]:
    """A signed value as two registers, high word first."""
    return (value >> 16) & 0xFFFF, value & 0xFFFF


def _word(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : at + 2], "big")
