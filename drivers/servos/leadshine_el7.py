"""Leadshine EL7-RS servo drives in PR mode (positioning by register writes) on a `ModbusBus`.

Registers are from the EL7-RS manual and field projects with it; the status register 0B05h is assumed to have
the bit layout documented for 1003h of the maker's CS2RS family.  32-bit values are high word first.  A move
is one frame: the path-0 block 6200h..6207h, whose last word is the trigger.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import IntFlag
from typing import Self

from drivers.driver import Drive, DriverSettings, Seconds, ServoDriver
from drivers.errors import DeviceError, DeviceFault
from drivers.lines import ModbusBus, UnansweredWrite
from drivers.protocols import AxisStatus
from drivers.scaling import JointScaling
from drivers.servos.on_bus import POLL_S, OnBus
from drivers.servos.registers import values_of, words_of

CONTROL_MODE = 0x0003
ALARM_RESET = 0x0033
DIGITAL_INPUT_1 = 0x0401
DIGITAL_OUTPUTS = (0x0415, 0x0417, 0x0419, 0x041B, 0x041D)
ALARM = 0x0B02
MOTION_STATUS = 0x0B05
TRIGGER = 0x6002
OUTPUT_STATUS = 0x602F
FEEDBACK = 0x602C
PATH_0 = 0x6200

MODE_PR = 6
SERVO_ON_ALWAYS = 0x0083
RESET_PRESENT_ALARM = 0x1111
RUN_PATH_0 = 0x0010
DECLARE_ZERO = 0x0021
QUICK_STOP = 0x0040
MOVE_ABSOLUTE = 0x0001
OUTPUT_IS_ALARM = 0x01
OUTPUT_IS_SERVO_ON = 0x12

_RAMP_MS_PER_1000_RPM = 100
_ENABLE_TIMEOUT_S = 2.0


class MotionStatus(IntFlag):
    """Bits of 0B05h."""

    FAULT = 1 << 0
    ENABLED = 1 << 1
    RUNNING = 1 << 2
    COMMAND_COMPLETE = 1 << 4
    PATH_COMPLETE = 1 << 5
    HOMED = 1 << 6


class LeadshineSettings(DriverSettings):
    """Options of `profile = "leadshine-el7"`."""

    timeout_s: Seconds = 0.3
    """Longest time that a drive on this line takes to reply."""


@dataclass(frozen=True, slots=True)
class FamilyRegisters:
    """Differences between the maker's families."""

    motion_status: int
    alarm: int
    alarm_reset: int
    switch_on: tuple[int, int]
    """Register and value that switch it on."""


class LeadshineEL7(OnBus):
    """One drive as a `ServoAxis`; may be called from any thread."""

    _registers = FamilyRegisters(MOTION_STATUS, ALARM, ALARM_RESET, (DIGITAL_INPUT_1, SERVO_ON_ALWAYS))

    def __init__(self, bus: ModbusBus, unit: int, scaling: JointScaling, *, name: str) -> None:
        super().__init__(bus, unit, scaling, name=name)
        self._servo_on_bit = 0
        self._alarm_bit = 0

    @classmethod
    def on_line(cls, settings: LeadshineSettings, drives: Sequence[Drive]) -> tuple[Self, ...]:
        """One axis per drive; nothing is opened yet. :raises BadUrl:"""
        bus = ModbusBus(settings.url, timeout_s=settings.timeout_s)
        return tuple(cls(bus, drive.unit, drive.scaling, name=drive.name) for drive in drives)

    def connect(self) -> None:
        """Open the line, check that the drive is in PR mode, and find the output for "servo on".

        :raises DeviceError: with the error and what to check
        """
        self._target_pulses = None
        self._bus.open(self)
        try:
            self._check_settings()
        except DeviceError:
            self._bus.release(self)
            raise

    def _check_settings(self) -> None:
        """Check directly after opening the line. :raises DeviceError: with the error and what to check"""
        mode = self._read(CONTROL_MODE)
        if mode != MODE_PR:
            raise DeviceFault(
                f"{self._commands.title} is in control mode {mode}; set P00.01 to {MODE_PR} (PR mode)"
                " and switch it off and on."
            )
        functions = [self._read(address) for address in DIGITAL_OUTPUTS]
        if OUTPUT_IS_SERVO_ON not in functions:
            raise DeviceFault(
                f"{self._commands.title} has no output for servo-on;"
                f" set one of P04.10 to P04.14 to {OUTPUT_IS_SERVO_ON:02X}h."
            )
        self._servo_on_bit = 1 << functions.index(OUTPUT_IS_SERVO_ON)
        self._alarm_bit = 1 << functions.index(OUTPUT_IS_ALARM) if OUTPUT_IS_ALARM in functions else 0

    def _enabled_and_alarmed(self, motion: MotionStatus) -> tuple[bool, bool]:
        """Read from the motion status, and from the outputs if they contain it."""
        outputs = self._read(OUTPUT_STATUS)
        alarmed = MotionStatus.FAULT in motion or bool(outputs & self._alarm_bit)
        return bool(outputs & self._servo_on_bit), alarmed

    def close(self) -> None:
        self._bus.release(self)

    def enable(self) -> None:
        """Power the axis and wait until it confirms.

        :raises DeviceFault: an alarm is active, or the drive does not switch on in time
        :raises LinkLost: there is no reply
        """
        self._commands.refuse_on_alarm(self.status())
        with suppress(UnansweredWrite):  # the wait below determines whether it was accepted
            self._bus.write_one(self._unit, *self._registers.switch_on)
        deadline_s = time.monotonic() + _ENABLE_TIMEOUT_S
        while not (status := self.status()).enabled:
            self._commands.refuse_on_alarm(status)
            if time.monotonic() > deadline_s:
                raise DeviceFault(
                    f"{self._commands.title} does not switch on; check its power stage and safety input."
                )
            time.sleep(POLL_S)

    def move_to(self, theta_deg: float, speed_deg_s: float) -> None:
        """Start an absolute move and return at once (one frame on the wire).

        It is sent again, once, only if its reply is missing and the drive does not have its target.

        :raises DeviceFault: the axis is not enabled or in alarm, or the move is out of range, refused, or
        overtaken by a stop
        :raises LinkLost: the reply is missing and the state read back does not show the move
        """
        asked_at = self._bus.stops
        target = self._commands.pulses(theta_deg)
        rpm = self._commands.rpm(speed_deg_s)
        self._check_ready()
        block = [
            MOVE_ABSOLUTE,
            *words_of(target),
            rpm,
            _RAMP_MS_PER_1000_RPM,
            _RAMP_MS_PER_1000_RPM,
            0,
            RUN_PATH_0,
        ]
        try:
            self._bus.write(self._unit, PATH_0, block, stops_seen=asked_at)
        except UnansweredWrite:
            if not self._holds_target(target):
                self._bus.write(self._unit, PATH_0, block, stops_seen=asked_at)
            elif not self._runs_or_stands_at(target):
                raise
        self._target_pulses = target

    def status(self) -> AxisStatus:
        motion = MotionStatus(self._read(self._registers.motion_status))
        enabled, alarmed = self._enabled_and_alarmed(motion)
        alarm = None
        if alarmed:
            alarm = self._read(self._registers.alarm) or None  # it may have been reset between two reads
        moving = MotionStatus.RUNNING in motion
        return AxisStatus(
            enabled=enabled,
            moving=moving,
            in_position=MotionStatus.PATH_COMPLETE in motion and not moving and self._is_at_target(),
            alarm=alarm,
        )

    def reset_alarm(self) -> None:
        """Clear the present alarm.

        :raises DeviceFault: it remains
        :raises LinkLost: there is no reply
        """
        with suppress(UnansweredWrite):  # the alarm register shows the result
            self._bus.write_one(self._unit, self._registers.alarm_reset, RESET_PRESENT_ALARM)
        self._wait_for_reset()

    def quick_stop(self) -> None:
        self._write_stop(TRIGGER, QUICK_STOP, look_at=self._registers.motion_status)

    def preset(self, theta_deg: float) -> None:
        """Declare the present position to be `theta_deg`.

        The drive can only declare its zero, so `theta_deg` must be the joint's `zero_at_deg` (within half a
        pulse): move the arm to that true angle, then preset.

        :raises DeviceFault: the angle is another, the axis moves, or the value reads back different
        :raises LinkLost: there is no reply
        """
        self._commands.check_zero_angle(theta_deg)
        self._commands.refuse_while_moving(self.status())
        with suppress(UnansweredWrite):  # the position read back shows the result
            self._bus.write_one(self._unit, TRIGGER, DECLARE_ZERO)
        self._check_zero_taken()

    def _read(self, address: int) -> int:
        return self._bus.read(self._unit, address, 1)[0]

    def _feedback_pulses(self) -> int:
        return values_of(self._bus.read(self._unit, FEEDBACK, 2))[0]

    def _holds_target(self, target: int) -> bool:
        """Whether the drive received the move, after a lost reply."""
        return values_of(self._bus.read(self._unit, PATH_0 + 1, 2)) == [target]

    def _runs_or_stands_at(self, target: int) -> bool:
        motion = MotionStatus(self._read(self._registers.motion_status))
        return MotionStatus.RUNNING in motion or self._stands_at(target)


REGISTERS = {
    CONTROL_MODE: "control mode",
    ALARM_RESET: "alarm reset",
    DIGITAL_INPUT_1: "function of input 1",
    **{address: f"function of output {n}" for n, address in enumerate(DIGITAL_OUTPUTS, start=1)},
    ALARM: "alarm",
    MOTION_STATUS: "motion status",
    TRIGGER: "trigger",
    OUTPUT_STATUS: "outputs",
    FEEDBACK: "position, pulses",
    PATH_0: "path 0: mode, target, speed, ramps, pause, trigger",
    PATH_0 + 1: "target of path 0, pulses",
}

DRIVER = ServoDriver(LeadshineSettings, LeadshineEL7.on_line, REGISTERS, FEEDBACK)
