"""The registers of one Leadshine EL7-RS drive in PR mode, in front of an axis of the machine."""

from __future__ import annotations

from typing import Final

from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine

ILLEGAL_FUNCTION, ILLEGAL_ADDRESS, ILLEGAL_VALUE = 0x01, 0x02, 0x03
_READ, _WRITE_ONE, _WRITE = 0x03, 0x06, 0x10
_MOST_READ, _MOST_WRITTEN = 125, 123

_CONTROL_MODE, _ALARM_RESET, _DIGITAL_INPUT_1 = 0x0003, 0x0033, 0x0401
_ALARM, _MOTION_STATUS, _POSITION = 0x0B02, 0x0B05, 0x0B1C
_TRIGGER, _FEEDBACK, _INPUTS, _OUTPUTS = 0x6002, 0x602C, 0x602E, 0x602F
_PATH_0, _PATH_TRIGGER = 0x6200, 0x6207
_SERVO_ON_ALWAYS = 0x0083
_RUN_PATH_0, _DECLARE_ZERO, _QUICK_STOP = 0x0010, 0x0021, 0x0040
_RESETS = (0x1111, 0x1122)
_ABSOLUTE, _RELATIVE = 0x0001, 0x0041
_POSITION_DEVIATION_ALARM: Final = 0x180
_LOST_PULSES = 500

_PARAMETERS = {
    _CONTROL_MODE: 6,
    _ALARM_RESET: 0,
    _DIGITAL_INPUT_1: 0x0003,
    0x0415: 0x01,  # output 1: alarm
    0x0417: 0x02,  # output 2: ready
    0x0419: 0x12,  # output 3: servo on
    0x041B: 0x03,  # output 4: brake released
    0x041D: 0x00,
    0x053B: 5,  # 38400 baud
    _TRIGGER: 0,
}


class EL7Drive:
    """Answers request PDUs (function code and data, no address, no check sum)."""

    def __init__(self, machine: Machine, joint: int, faults: Faults) -> None:
        self._machine = machine
        self._joint: Final = 1 if joint == 1 else 2
        self._axis = machine.axes[joint - 1]
        self._faults = faults
        self._registers = dict(_PARAMETERS)
        self._registers.update({_PATH_0 + i: 0 for i in range(8)})
        self._alarm = 0
        self._in_position = True
        self._never_in_position = False
        self.never_in_position = False
        self.frozen = False
        """While true, the feedback does not change."""
        self._frozen_pulses: int | None = None
        self._lost_pulses = 0

    def raise_alarm(self, code: int = 0) -> None:
        """Stop and show an alarm; 0 is that of a following error."""
        self._machine.quick_stop(self._joint)
        self._alarm = code or _POSITION_DEVIATION_ALARM

    def lose_counts(self) -> None:
        """The encoder has missed pulses: from now on it counts from elsewhere."""
        self._axis.zero_pulses += _LOST_PULSES
        self._lost_pulses += _LOST_PULSES

    def reboot(self) -> None:
        """As after a power cut: switched off, stopped, and counting from where it stands."""
        self._machine.quick_stop(self._joint)
        self._registers[_DIGITAL_INPUT_1] = _PARAMETERS[_DIGITAL_INPUT_1]
        self._lost_pulses += self._axis.feedback_pulses()
        self._axis.declare_zero()

    def find_reference(self) -> None:
        """What was lost is found again, as after homing."""
        self._axis.zero_pulses -= self._lost_pulses
        self._lost_pulses = 0

    def answer(self, request: bytes) -> bytes:
        """The reply PDU, an exception included."""
        function = request[0] if request else 0
        fault = self._faults.due("drive_exception", self._joint)
        if fault is not None:
            return _exception(function, fault.code or ILLEGAL_VALUE)
        if function == _READ:
            return self._read(request)
        if function == _WRITE_ONE:
            return self._write_one(request)
        if function == _WRITE:
            return self._write(request)
        return _exception(function, ILLEGAL_FUNCTION)

    def _read(self, request: bytes) -> bytes:
        address, count = _word(request, 1), _word(request, 3)
        if len(request) != 5 or not 1 <= count <= _MOST_READ:
            return _exception(_READ, ILLEGAL_VALUE)
        registers = self._registers | self._live()
        try:
            values = [registers[address + i] for i in range(count)]
        except KeyError:
            return _exception(_READ, ILLEGAL_ADDRESS)
        return bytes((_READ, 2 * count)) + b"".join(value.to_bytes(2, "big") for value in values)

    def _write_one(self, request: bytes) -> bytes:
        if len(request) != 5:
            return _exception(_WRITE_ONE, ILLEGAL_VALUE)
        code = self._store(_word(request, 1), [_word(request, 3)])
        return _exception(_WRITE_ONE, code) if code else request

    def _write(self, request: bytes) -> bytes:
        count = _word(request, 3)
        if not 1 <= count <= _MOST_WRITTEN or len(request) != 6 + 2 * count or request[5] != 2 * count:
            return _exception(_WRITE, ILLEGAL_VALUE)
        code = self._store(_word(request, 1), [_word(request, 6 + 2 * i) for i in range(count)])
        return _exception(_WRITE, code) if code else request[:5]

    def _store(self, address: int, values: list[int]) -> int:
        """Registers are taken in order; the answer is an exception code or 0."""
        if any(address + i not in self._registers for i in range(len(values))):
            return ILLEGAL_ADDRESS
        for register, value in enumerate(values, address):
            if register == _ALARM_RESET and value in _RESETS:
                self._alarm = 0
            elif register in (_TRIGGER, _PATH_TRIGGER):
                code = self._trigger(value)
                if code:
                    return code
            else:
                self._registers[register] = value
        return 0

    def _trigger(self, value: int) -> int:
        if value == _RUN_PATH_0:
            return self._run_path_0()
        if value == _QUICK_STOP:
            self._machine.quick_stop(self._joint)
            self._in_position = False
        elif value == _DECLARE_ZERO:
            if self._axis.moving:
                return ILLEGAL_VALUE
            self._machine.declare_zero(self._joint)
            self._lost_pulses = 0
        elif value:
            return ILLEGAL_VALUE
        return 0

    def _run_path_0(self) -> int:
        mode, speed_rpm, ramp_ms = (self._registers[_PATH_0 + i] for i in (0, 3, 4))
        if not self._enabled or self._alarm or mode not in (_ABSOLUTE, _RELATIVE) or not speed_rpm:
            return ILLEGAL_VALUE
        fault = self._faults.due("drive_alarm", self._joint)
        if fault is not None:
            self._machine.quick_stop(self._joint)
            self._alarm = fault.code or _POSITION_DEVIATION_ALARM
            return 0
        self._never_in_position = self._faults.due("drive_never_in_position", self._joint) is not None
        target = _signed(self._registers[_PATH_0 + 1], self._registers[_PATH_0 + 2])
        if mode == _RELATIVE:
            target += self._axis.feedback_pulses()
        self._machine.command(self._joint, target, speed_rpm, 1000 * 1000 / max(1, ramp_ms))
        self._in_position = True
        return 0

    @property
    def _enabled(self) -> bool:
        return self._registers[_DIGITAL_INPUT_1] == _SERVO_ON_ALWAYS and not self._alarm

    def _feedback_pulses(self) -> int:
        if not self.frozen:
            self._frozen_pulses = None
            return self._axis.feedback_pulses()
        if self._frozen_pulses is None:
            self._frozen_pulses = self._axis.feedback_pulses()
        return self._frozen_pulses

    def _live(self) -> dict[int, int]:
        """Registers that show the drive's state."""
        moving = self._axis.moving
        in_position = self._in_position and not (self._never_in_position or self.never_in_position)
        complete = not moving and in_position
        pulses = self._feedback_pulses()
        high, low = (pulses >> 16) & 0xFFFF, pulses & 0xFFFF
        enabled = self._enabled
        status = (self._alarm > 0) | enabled << 1 | moving << 2 | complete << 4 | complete << 5
        outputs = (self._alarm > 0) | (self._alarm == 0) << 1 | enabled << 2 | enabled << 3
        return {
            _ALARM: self._alarm,
            _MOTION_STATUS: status,
            _POSITION: high,
            _POSITION + 1: low,
            _FEEDBACK: high,
            _FEEDBACK + 1: low,
            _INPUTS: int(enabled),
            _OUTPUTS: outputs,
        }


def _exception(function: int, code: int) -> bytes:
    return bytes((function | 0x80, code))


def _word(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : at + 2], "big")


def _signed(high: int, low: int) -> int:
    value = high << 16 | low
    return value - (1 << 32) if high & 0x8000 else value
