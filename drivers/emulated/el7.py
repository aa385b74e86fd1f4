"""The registers of one Leadshine drive in PR mode, in front of an axis of the machine."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.emulated.drive import ILLEGAL_ADDRESS, ILLEGAL_VALUE, EmulatedDrive, pair, signed
from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine

_TRIGGER, _FEEDBACK, _INPUTS, _OUTPUTS = 0x6002, 0x602C, 0x602E, 0x602F
_PATH_0, _PATH_TRIGGER = 0x6200, 0x6207
_RUN_PATH_0, _DECLARE_ZERO, _QUICK_STOP = 0x0010, 0x0021, 0x0040
_RESETS = (0x1111, 0x1122)
_ABSOLUTE, _RELATIVE = 0x0001, 0x0041


@dataclass(frozen=True, slots=True)
class LeadshineFamily:
    """Differences between the maker's families."""

    parameters: dict[int, int]
    """Registers that retain written values, with the factory settings."""
    enable: int
    on: int
    """Value that switches it on, and its register."""
    alarm: int
    alarm_reset: int
    motion_status: int
    positions: tuple[int, ...]
    """Registers with the position, beside 602Ch."""


EL7 = LeadshineFamily(
    parameters={
        0x0003: 6,  # control mode: PR
        0x0033: 0,
        0x0401: 0x0003,  # input 1: servo on, external
        0x0415: 0x01,  # output 1: alarm
        0x0417: 0x02,  # output 2: ready
        0x0419: 0x12,  # output 3: servo on
        0x041B: 0x03,  # output 4: brake released
        0x041D: 0x00,
        0x053B: 5,  # 38400 baud
    },
    enable=0x0401,
    on=0x0083,
    alarm=0x0B02,
    alarm_reset=0x0033,
    motion_status=0x0B05,
    positions=(0x0B1C,),
)
CS2RS = LeadshineFamily(
    parameters={0x0001: 10_000, 0x000F: 0, 0x1801: 0},
    enable=0x000F,
    on=1,
    alarm=0x2203,
    alarm_reset=0x1801,
    motion_status=0x1003,
    positions=(0x1014,),
)


class EL7Drive(EmulatedDrive):
    """One drive."""

    following_error_alarm = 0x180
    check_sum_exception = 0x08

    def __init__(self, machine: Machine, joint: int, faults: Faults, family: LeadshineFamily = EL7) -> None:
        registers = dict(family.parameters)
        registers.update({_TRIGGER: 0, **{_PATH_0 + i: 0 for i in range(8)}})
        super().__init__(machine, joint, faults, registers)
        self._family = family

    def _switch_off(self) -> None:
        self._registers[self._family.enable] = self._family.parameters[self._family.enable]

    def _store(self, address: int, values: list[int]) -> int:
        if any(address + i not in self._registers for i in range(len(values))):
            return ILLEGAL_ADDRESS
        for register, value in enumerate(values, address):
            if register == self._family.alarm_reset and value in _RESETS:
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
            self._stop()
        elif value == _DECLARE_ZERO:
            return self._declare_zero()
        elif value:
            return ILLEGAL_VALUE
        return 0

    def _run_path_0(self) -> int:
        mode, speed_rpm, ramp_ms = (self._registers[_PATH_0 + i] for i in (0, 3, 4))
        if not self._enabled or self._alarm or mode not in (_ABSOLUTE, _RELATIVE) or not speed_rpm:
            return ILLEGAL_VALUE
        target = signed(self._registers[_PATH_0 + 1], self._registers[_PATH_0 + 2])
        if mode == _RELATIVE:
            target += self._axis.feedback_pulses()
        self._move(target, speed_rpm, 1000 * 1000 / max(1, ramp_ms))
        return 0

    @property
    def _enabled(self) -> bool:
        return self._registers[self._family.enable] == self._family.on and not self._alarm

    def _live(self) -> dict[int, int]:
        moving, complete, enabled = self._axis.moving, self._arrived, self._enabled
        high, low = pair(self._feedback_pulses())
        status = (self._alarm > 0) | enabled << 1 | moving << 2 | complete << 4 | complete << 5
        outputs = (self._alarm > 0) | (self._alarm == 0) << 1 | enabled << 2 | enabled << 3
        live = {
            self._family.alarm: self._alarm,
            self._family.motion_status: status,
            _INPUTS: int(enabled),
            _OUTPUTS: outputs,
        }
        for address in (_FEEDBACK, *self._family.positions):
            live[address], live[address + 1] = high, low
        return live
