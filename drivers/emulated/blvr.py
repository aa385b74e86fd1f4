"""The registers of one Oriental Motor BLV-R drive in direct data operation, in front of an axis.

Its communication watchdog runs by itself: a drive that receives nothing for the set time stops with alarm
85h.
"""

from __future__ import annotations

import time
from threading import Event, Thread

from drivers.emulated.drive import ILLEGAL_VALUE, EmulatedDrive, pair, signed
from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine

SLAVE_ERROR = 0x04
_DIRECT_DATA, _TYPE, _POSITION, _VELOCITY, _ACCELERATION, _TRIGGER = (
    *(0x0058, 0x005A, 0x005C, 0x005E, 0x0060),
    0x0066,
)
_INPUTS, _OUTPUTS, _ALARM, _FEEDBACK = 0x007C, 0x007E, 0x0080, 0x00CC
_ALARM_RESET, _PRESET, _RESOLUTION, _WATCHDOG = 0x0180, 0x018A, 0x0350, 0x138A
_SERVO_ON, _QUICK_STOP = 1 << 0, 1 << 4
_ABSOLUTE, _START = 1, 1
_READY, _POSITION_KNOWN, _ALARMED, _IN_POSITION, _MOVING = 1 << 3, 1 << 4, 1 << 7, 1 << 9, 1 << 13
_SILENCE_ALARM = 0x85
_LOOK_S = 0.005
_ITEMS = (
    *range(_DIRECT_DATA, 0x0068, 2),
    *(_INPUTS, _ALARM_RESET, _PRESET, _RESOLUTION, _RESOLUTION + 2, _WATCHDOG),
)


class BLVRDrive(EmulatedDrive):
    """One drive; close it, because its watchdog has a thread."""

    following_error_alarm = 0x10

    def __init__(self, machine: Machine, joint: int, faults: Faults, counts_per_rev: int) -> None:
        registers = {address + half: 0 for address in _ITEMS for half in (0, 1)}
        registers[_RESOLUTION + 1], registers[_RESOLUTION + 3] = counts_per_rev, 1
        super().__init__(machine, joint, faults, registers)
        self._silent_s = 0.0
        self._closing = Event()
        self._thread = Thread(target=self._watch, name=f"emulated watchdog of joint {joint}")
        self._thread.start()

    def close(self) -> None:
        self._closing.set()
        self._thread.join()

    def answer(self, request: bytes) -> bytes:
        self._silent_s = 0.0
        return super().answer(request)

    def _watch(self) -> None:
        """Only silence while this program runs counts: a real drive would have received delayed data."""
        looked_s = time.monotonic()
        while not self._closing.wait(_LOOK_S):
            now_s = time.monotonic()
            self._silent_s += min(now_s - looked_s, 2 * _LOOK_S)
            looked_s = now_s
            limit_s = self._item(_WATCHDOG) / 1000
            if limit_s and not self._alarm and self._silent_s > limit_s:
                self.raise_alarm(_SILENCE_ALARM)

    def _switch_off(self) -> None:
        self._put(_INPUTS, 0)
        self._put(_WATCHDOG, 0)

    def _store(self, address: int, values: list[int]) -> int:
        """Registers that are written before a refused one stay written (manual, p. 242)."""
        wanted = range(address, address + len(values))
        if address % 2 or len(values) % 2 or any(register not in self._registers for register in wanted):
            return ILLEGAL_VALUE
        for item in range(address, address + len(values), 2):
            before = self._item(item)
            at = item - address
            self._registers[item], self._registers[item + 1] = values[at], values[at + 1]
            if code := self._act(item, before):
                return code
        return 0

    def _act(self, item: int, before: int) -> int:
        """The reaction to a new value; an exception code or 0."""
        value = self._item(item)
        edge = before == 0 and value == 1
        if item == _INPUTS and value & _QUICK_STOP:
            self._stop()
        elif item == _TRIGGER and value == _START:
            self._put(_TRIGGER, 0)
            return self._start()
        elif item == _ALARM_RESET and edge:
            self._alarm = 0
        elif item == _PRESET and edge:
            return SLAVE_ERROR if self._declare_zero() else 0
        return 0

    def _start(self) -> int:
        rpm, ramp_ms = self._item(_VELOCITY), self._item(_ACCELERATION)
        if self._item(_TYPE) != _ABSOLUTE or rpm <= 0 or not self._ready:
            return SLAVE_ERROR
        if self._item(_INPUTS) & _QUICK_STOP:
            return 0  # it is held: nothing moves
        self._move(self._item(_POSITION), rpm, 1000 * 1000 / max(1, ramp_ms))
        return 0

    @property
    def _ready(self) -> bool:
        return bool(self._item(_INPUTS) & _SERVO_ON) and not self._alarm

    def _live(self) -> dict[int, int]:
        outputs = (
            (_SERVO_ON | _READY if self._ready else 0)
            | _POSITION_KNOWN
            | (_ALARMED if self._alarm else 0)
            | (_IN_POSITION if self._arrived else 0)
            | (_MOVING if self._axis.moving else 0)
        )
        items = {_OUTPUTS: outputs, _ALARM: self._alarm, _FEEDBACK: self._feedback_pulses()}
        return {address + half: pair(value)[half] for address, value in items.items() for half in (0, 1)}

    def _item(self, address: int) -> int:
        return signed(self._registers[address], self._registers[address + 1])

    def _put(self, address: int, value: int) -> None:
        self._registers[address], self._registers[address + 1] = pair(value)
