"""Oriental Motor BLV-R drives in direct data operation on a `ModbusBus` (function manual HP-5142-6).

Every item is 32 bits in two registers, upper half first, written together.  A move is one frame: the direct
data 0058h..0067h, whose last item is the trigger.  Input bits act by level, so a stop is active until the
next move clears it. The drive has a communication watchdog: it is set, read back and fed, so the motor stops
if the station dies or freezes.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from enum import IntFlag
from threading import Event, Thread
from typing import Annotated, Self

from pydantic import Field

from drivers.driver import Drive, DriverSettings, Seconds, ServoDriver
from drivers.errors import DeviceError, DeviceFault
from drivers.lines import ModbusBus, UnansweredWrite
from drivers.protocols import AxisStatus
from drivers.scaling import JointScaling
from drivers.servos.on_bus import POLL_S, OnBus
from drivers.servos.registers import values_of, words_of

DIRECT_DATA, POSITION_DATA = 0x0058, 0x005C
INPUTS, OUTPUTS, ALARM = 0x007C, 0x007E, 0x0080
FEEDBACK = 0x00CC
ALARM_RESET, PRESET = 0x0180, 0x018A
RESOLUTION = 0x0350
WATCHDOG = 0x138A

SERVO_ON, QUICK_STOP = 1 << 0, 1 << 4
MOVE_ABSOLUTE, START, FULL_TORQUE = 1, 1, 1000

_RAMP_MS = 100
_ENABLE_TIMEOUT_S = 2.0
_FEEDS_PER_TIMEOUT = 10


class Output(IntFlag):
    """Low half of 007Eh."""

    SERVO_ON = 1 << 0
    READY = 1 << 3
    POSITION_KNOWN = 1 << 4
    ALARM = 1 << 7
    IN_POSITION = 1 << 9
    MOVING = 1 << 13


class OrientalMotorSettings(DriverSettings):
    """Options of `profile = "orientalmotor"`."""

    timeout_s: Seconds = 0.3
    """Longest time that a drive on this line takes to reply."""
    watchdog_ms: Annotated[int, Field(ge=0, le=10_000)] = 250
    """Time without communication after which a drive stops with alarm 85h; 0: off."""


class OrientalMotorBLVR(OnBus):
    """One drive as a `ServoAxis`; may be called from any thread."""

    def __init__(
        self, bus: ModbusBus, unit: int, scaling: JointScaling, *, name: str, watchdog_ms: int
    ) -> None:
        super().__init__(bus, unit, scaling, name=name)
        self._watchdog_ms = watchdog_ms
        self._stop_is_held = False
        self._feeder: _Feeder | None = None

    @classmethod
    def on_line(cls, settings: OrientalMotorSettings, drives: Sequence[Drive]) -> tuple[Self, ...]:
        """One axis per drive; nothing is opened yet. :raises BadUrl:"""
        bus = ModbusBus(settings.url, timeout_s=settings.timeout_s)
        return tuple(
            cls(bus, drive.unit, drive.scaling, name=drive.name, watchdog_ms=settings.watchdog_ms)
            for drive in drives
        )

    def connect(self) -> None:
        """Open the line, compare the resolution, set the watchdog and begin to feed it.

        :raises DeviceError: with the error and what to check
        """
        self.close()
        self._target_pulses = None
        self._stop_is_held = True  # an earlier user of the drive may have left it active
        self._bus.open(self)
        try:
            numerator, denominator = values_of(self._bus.read(self._unit, RESOLUTION, 4))
            if numerator != self._scaling.counts_per_rev * denominator:
                raise DeviceFault(
                    f"{self._commands.title} counts {numerator}/{denominator} steps a turn,"
                    f" the station file says {self._scaling.counts_per_rev}; correct one of them."
                )
            self._set_watchdog(self._watchdog_ms)
        except DeviceError:
            self._bus.release(self)
            raise
        if self._watchdog_ms and not self.line.is_played_back:
            period_s = self._watchdog_ms / 1000 / _FEEDS_PER_TIMEOUT
            self._feeder = _Feeder(self._feed, lambda: self._bus.silent_s(self._unit), period_s, self._name)

    def close(self) -> None:
        """Close without an alarm: the drive's watchdog must not trip because communication ended."""
        if self._feeder is not None:
            self._feeder.close()
            self._feeder = None
            with suppress(DeviceError):
                self._set_watchdog(0)
        self._bus.release(self)

    def enable(self) -> None:
        """Power the axis and wait until it accepts moves.

        :raises DeviceFault: an alarm is active, its position is unknown, or it does not switch on in time
        :raises LinkLost: there is no reply
        """
        self._commands.refuse_on_alarm(self.status())
        with suppress(UnansweredWrite):  # the wait below determines whether it was accepted
            self._write(INPUTS, SERVO_ON)
        self._stop_is_held = False
        deadline_s = time.monotonic() + _ENABLE_TIMEOUT_S
        while not (outputs := self._outputs()) & Output.READY:
            self._commands.refuse_on_alarm(self.status())
            if time.monotonic() > deadline_s:
                raise DeviceFault(
                    f"{self._commands.title} does not switch on; check its power stage and safety input."
                )
            time.sleep(POLL_S)
        if not outputs & Output.POSITION_KNOWN:
            raise DeviceFault(
                f"{self._commands.title} does not know its position; home it or preset it first."
            )

    def move_to(self, theta_deg: float, speed_deg_s: float) -> None:
        """Start an absolute move and return at once (one frame on the wire).

        It is sent again, once, only if its reply is missing and the drive does not have its target.

        :raises DeviceFault: the axis is not enabled or in alarm, or the move is out of range, refused, or
        overtaken by a stop
        :raises LinkLost: the reply is missing and the state read back does not show the move
        """
        asked_at = self._bus.stops
        target, rpm = self._commands.pulses(theta_deg), self._commands.rpm(speed_deg_s)
        self._check_ready()
        if self._stop_is_held:
            self._bus.write(self._unit, INPUTS, words_of(SERVO_ON), stops_seen=asked_at)
            self._stop_is_held = False
        items = (0, MOVE_ABSOLUTE, target, rpm, _RAMP_MS, _RAMP_MS, FULL_TORQUE, START)
        block = words_of(*items)
        try:
            self._bus.write(self._unit, DIRECT_DATA, block, stops_seen=asked_at)
        except UnansweredWrite:
            if self._read(POSITION_DATA) != target:
                self._bus.write(self._unit, DIRECT_DATA, block, stops_seen=asked_at)
            elif not (self._outputs() & Output.MOVING or self._stands_at(target)):
                raise
        self._target_pulses = target

    def status(self) -> AxisStatus:
        outputs = self._outputs()
        alarm = None
        if outputs & Output.ALARM:
            alarm = self._read(ALARM) & 0xFFFF or None  # it may have been reset between two reads
        moving = bool(outputs & Output.MOVING)
        return AxisStatus(
            enabled=bool(outputs & Output.SERVO_ON),
            moving=moving,
            in_position=bool(outputs & Output.IN_POSITION) and not moving and self._is_at_target(),
            alarm=alarm,
        )

    def reset_alarm(self) -> None:
        """Clear the present alarm.

        :raises DeviceFault: it remains
        :raises LinkLost: there is no reply
        """
        self._edge(ALARM_RESET)
        self._wait_for_reset()

    def quick_stop(self) -> None:
        """Stop now, ahead of any queued request on the line; the stop is active until the next move.

        :raises DeviceError: no attempt was confirmed
        """
        self._stop_is_held = True
        self._write_stop(INPUTS, words_of(SERVO_ON | QUICK_STOP), look_at=OUTPUTS)

    def preset(self, theta_deg: float) -> None:
        """Declare the present position to be `theta_deg`, which must be the joint's `zero_at_deg`.

        :raises DeviceFault: the angle is another, the axis moves, or the value reads back different
        :raises LinkLost: there is no reply
        """
        self._commands.check_zero_angle(theta_deg)
        self._commands.refuse_while_moving(self.status())
        self._edge(PRESET)
        self._check_zero_taken()

    def _set_watchdog(self, timeout_ms: int) -> None:
        """:raises DeviceFault: the drive did not accept it"""
        with suppress(UnansweredWrite):  # the value read back decides
            self._write(WATCHDOG, timeout_ms)
        if (set_ms := self._read(WATCHDOG)) != timeout_ms:
            raise DeviceFault(
                f"{self._commands.title} has a communication watchdog of {set_ms} ms instead of {timeout_ms}."
            )

    def _feed(self) -> None:
        with suppress(DeviceError):  # the user of the drive will detect it
            self._outputs()

    def _outputs(self) -> Output:
        return Output(self._read(OUTPUTS) & 0xFFFF & sum(Output))

    def _read(self, address: int) -> int:
        (value,) = values_of(self._bus.read(self._unit, address, 2))
        return value

    def _write(self, address: int, value: int) -> None:
        self._bus.write(self._unit, address, words_of(value), stops_seen=self._bus.stops)

    def _edge(self, address: int) -> None:
        """Maintenance commands act on the change from 0 to 1; the value read back afterwards decides."""
        for value in (0, 1):
            with suppress(UnansweredWrite):
                self._write(address, value)

    def _feedback_pulses(self) -> int:
        return self._read(FEEDBACK)


class _Feeder:
    """Sends to a drive often enough for its watchdog, until closed; stops and freezes with the process.

    Other requests to the drive feed it as well: this sends only after a pause without requests.
    """

    def __init__(
        self, feed: Callable[[], None], silent_s: Callable[[], float], period_s: float, name: str
    ) -> None:
        self._feed, self._silent_s, self._period_s = feed, silent_s, period_s
        self._closing = Event()
        self._thread = Thread(target=self._run, name=f"watchdog of {name}", daemon=True)
        self._thread.start()

    def close(self) -> None:
        self._closing.set()
        self._thread.join()

    def _run(self) -> None:
        wait_s = self._period_s
        while not self._closing.wait(wait_s):
            wait_s = self._period_s - self._silent_s()
            if wait_s <= 0.0:
                self._feed()
                wait_s = self._period_s


REGISTERS = {
    DIRECT_DATA: "direct data: number, type, position, speed, ramps, torque, trigger",
    POSITION_DATA: "position of the direct data, steps",
    INPUTS: "inputs",
    OUTPUTS: "outputs",
    ALARM: "alarm",
    FEEDBACK: "position, steps",
    ALARM_RESET: "alarm reset",
    PRESET: "position preset",
    RESOLUTION: "resolution",
    WATCHDOG: "communication watchdog, ms",
}

DRIVER = ServoDriver(OrientalMotorSettings, OrientalMotorBLVR.on_line, REGISTERS, FEEDBACK)
