"""Leadshine CS2RS and iEM-RS integrated steppers in PR mode: as EL7-RS, with other registers.

They are switched on by a separate register, report "enabled" and "fault" in the motion status 1003h, and need
neither a control mode nor functions of outputs.
"""

from __future__ import annotations

from drivers.driver import ServoDriver
from drivers.errors import DeviceFault
from drivers.servos.leadshine_el7 import (
    FEEDBACK,
    PATH_0,
    TRIGGER,
    FamilyRegisters,
    LeadshineEL7,
    LeadshineSettings,
    MotionStatus,
)

PULSES_PER_REV, SWITCH_ON, MOTION_STATUS = 0x0001, 0x000F, 0x1003
ALARM_RESET, ALARM = 0x1801, 0x2203


class LeadshineCS2RS(LeadshineEL7):
    """One drive as a `ServoAxis`; may be called from any thread."""

    _registers = FamilyRegisters(MOTION_STATUS, ALARM, ALARM_RESET, (SWITCH_ON, 1))

    def _check_settings(self) -> None:
        pulses = self._read(PULSES_PER_REV)
        if pulses != self._scaling.counts_per_rev:
            raise DeviceFault(
                f"{self._commands.title} counts {pulses} pulses a turn, the station file says"
                f" {self._scaling.counts_per_rev}; correct one of them."
            )

    def _enabled_and_alarmed(self, motion: MotionStatus) -> tuple[bool, bool]:
        return MotionStatus.ENABLED in motion, MotionStatus.FAULT in motion


REGISTERS = {
    PULSES_PER_REV: "pulses a turn",
    SWITCH_ON: "switch on",
    MOTION_STATUS: "motion status",
    ALARM: "alarm",
    ALARM_RESET: "alarm reset",
    TRIGGER: "trigger",
    FEEDBACK: "position, pulses",
    PATH_0: "path 0: mode, target, speed, ramps, pause, trigger",
    PATH_0 + 1: "target of path 0, pulses",
}

DRIVER = ServoDriver(LeadshineSettings, LeadshineCS2RS.on_line, REGISTERS, FEEDBACK)
