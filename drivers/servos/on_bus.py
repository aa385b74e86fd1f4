"""The common base of all drives on a Modbus line, independent of their registers."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from contextlib import suppress

from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines import ModbusBus, OnLine
from drivers.protocols import AxisStatus
from drivers.scaling import JointScaling
from drivers.servos.joint_commands import JointCommands

_MAX_RPM = 3000
_IN_POSITION_PULSES = 20
_RESET_TIMEOUT_S = 1.0
POLL_S = 0.01
_BUDGET_S = 0.4
"""Time limit for one repetition: while a sensor is queried in motion, nothing else is monitored."""


class OnBus(OnLine, ABC):
    """A drive on a bus; also a `RegisterReader` for other units on it."""

    def __init__(self, bus: ModbusBus, unit: int, scaling: JointScaling, *, name: str) -> None:
        super().__init__(bus.line)
        self._bus = bus
        self._unit = unit
        self._scaling = scaling
        self._name = name
        self._commands = JointCommands(name, scaling, _MAX_RPM)
        self._target_pulses: int | None = None
        """Target of the latest move; None before it, and after a stop or a preset."""

    @property
    def name(self) -> str:
        return self._name

    @abstractmethod
    def status(self) -> AxisStatus:
        """The state of the drive; in position means: at the target of this object's latest move.

        :raises DeviceError:
        """

    @abstractmethod
    def quick_stop(self) -> None:
        """Stop now, ahead of any queued request on the line.

        :raises DeviceError: no attempt was confirmed
        """

    @abstractmethod
    def _feedback_pulses(self) -> int:
        """Position of the motor by the encoder."""

    def feedback_deg(self) -> float:
        """The encoder's joint angle.  :raises DeviceError:"""
        return self._scaling.to_deg(self._feedback_pulses())

    def make_safe(self) -> None:
        """Stop; the axis stays powered, since an arm without torque would fall."""
        with suppress(DeviceError):  # the caller has other axes to stop and cannot do more here
            self.quick_stop()

    def read_register(self, unit: int, address: int) -> int:
        """One holding register of a unit on the line, 0..65535.  :raises DeviceError:"""
        return self._bus.read(unit, address, 1, budget_s=_BUDGET_S)[0]

    def _check_ready(self) -> None:
        """Check before a move. :raises DeviceFault: an alarm is active, or the axis is not powered"""
        status = self.status()
        self._commands.refuse_on_alarm(status)
        if not status.enabled:
            raise DeviceFault(f"{self._commands.title} is not switched on.")

    def _wait_for_reset(self) -> None:
        """:raises DeviceFault: the alarm remains"""
        deadline_s = time.monotonic() + _RESET_TIMEOUT_S
        while (status := self.status()).alarm is not None:
            if time.monotonic() > deadline_s:
                self._commands.refuse_on_alarm(status)
            time.sleep(POLL_S)

    def _write_stop(self, address: int, value: int | Sequence[int], *, look_at: int) -> None:
        """:raises DeviceError: no attempt was confirmed"""
        self._target_pulses = None
        try:
            self._bus.stop(self._unit, address, value, look_at=look_at)
        except (LinkLost, GarbledReply) as error:
            cause = str(error).rstrip(".")
            raise LinkLost(
                f"{self._commands.title} did not confirm its stop; use the emergency stop. {cause}."
            ) from error

    def _check_zero_taken(self) -> None:
        """Check after a preset. :raises DeviceFault: the drive is not at its zero"""
        self._target_pulses = None
        pulses = self._feedback_pulses()
        if abs(pulses) > _IN_POSITION_PULSES:
            raise DeviceFault(
                f"{self._commands.title} stands at {pulses} pulses after its zero was set; it was not taken."
            )

    def _stands_at(self, target: int) -> bool:
        return abs(self._feedback_pulses() - target) <= _IN_POSITION_PULSES

    def _is_at_target(self) -> bool:
        """Checked against the target: the drive's own status may still be that of the previous move."""
        target = self._target_pulses  # a stop may clear it meanwhile
        return target is not None and self._stands_at(target)
