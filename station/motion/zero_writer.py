"""New zeros for the drives: move there, declare the zero, read it back, with a journal that survives a crash.

A drive can only declare its current position to be its zero. The servo's deviation from its command is stored
in the journal too, so the frame of every later angle is known to the pulse.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from drivers.errors import DeviceError
from station.errors import StepFailed, sentence
from station.five_bar import forward
from station.motion.machine import Machine
from station.motion.positioner import Positioner
from station.records import Angles, SetZeros, Stop, ZeroWrite
from station.store import Store

READ_BACK_PULSES = 4.5
"""Feedback comes in whole pulses, and a servo at standstill moves by some: eq. 35 is 1.3 (sd)."""
SETTLE_PULSES = 20.0
"""Maximum distance of the feedback from one of the two possible positions after an interrupted write."""


@dataclass
class Zeroing:
    """Writes the zeros of one run."""

    run_id: int
    machine: Machine
    positioner: Positioner
    store: Store

    def settle(self) -> None:
        """Before anything moves, determine whether the drives accepted a zero whose write was interrupted.

        :raises DeviceError:
        """
        for write in self._writes():
            if write.taken is not None:
                continue
            joint = self.positioner.joints[write.joint - 1]
            feedback = self._feedback(write.joint)
            here = min((joint.zero_at_deg, write.from_deg), key=lambda place: abs(feedback - place))
            if abs(feedback - here) * joint.scaling.pulses_per_deg <= SETTLE_PULSES:
                taken = here == joint.zero_at_deg
                self.store.end_zero_write(write.id, feedback if taken else None)

    def carry_out(self, step: SetZeros) -> Angles:
        """Move each joint to its new zero and declare it; returns the shifts since run `step.of`, deg.

        A joint whose old zero is to be restored and is still set is skipped.

        :raises Cancelled: the run was stopped; zeros written until then are in the journal.
        :raises DeviceError: a device failed.
        :raises StepFailed: the position is out of limits or not reached, or the zero reads back different.
        """
        if doubt := self.machine.make_safe():
            raise StepFailed(doubt)
        self._check_powered()
        self.positioner.prepare()
        self.settle()
        shift = shift_of(self._writes(step.of))
        joints = self.positioner.joints
        away = [offset + moved for offset, moved in zip(step.offsets_deg, shift, strict=True)]
        if due := [number for number in (1, 2) if away[number - 1]]:
            goal = (joints[0].zero_at_deg - away[0], joints[1].zero_at_deg - away[1])
            self.positioner.stand_at(Stop("zero", self._zero_place(), goal))
            try:
                for number in due:
                    self._write(number, step.offsets_deg[number - 1])
            except (DeviceError, StepFailed):
                with suppress(DeviceError):  # the next run will check again
                    self.settle()
                raise
            self.positioner.look()
        return shift_of(self._writes(step.of))

    def _check_powered(self) -> None:
        """Check that both drives are still powered since the run enabled them. One that lost its power may
        count from another position, and a zero written then would be wrong.

        :raises StepFailed: a drive has lost its power.
        """
        self.machine.connect_missing(axes_only=True)
        for axis in self.machine.devices.axes:
            status = self.machine.status(axis)
            if not status.enabled and status.alarm is None:
                raise StepFailed(
                    f"{sentence(axis.name)} has lost its power during this run and may count from elsewhere:"
                    " no zero is written; calibrate again."
                )

    def _write(self, number: int, offset_deg: float) -> None:
        self.positioner.check_cancel()
        joint, axis = self.positioner.joints[number - 1], self.machine.devices.axes[number - 1]
        write = self.store.begin_zero_write(self.run_id, number, offset_deg, self._feedback(number))
        with self.machine.using(axis):
            axis.preset(joint.zero_at_deg)
        after = self._feedback(number)
        if not abs(after - joint.zero_at_deg) * joint.scaling.pulses_per_deg <= READ_BACK_PULSES:
            raise StepFailed(
                f"The zero of joint {number} reads back {after:.4f} deg instead of {joint.zero_at_deg:g}."
            )
        self.store.end_zero_write(write, after)

    def _feedback(self, number: int) -> float:
        axis = self.machine.devices.axes[number - 1]
        with self.machine.using(axis):
            return axis.feedback_deg()

    def _writes(self, since: int = 0) -> list[ZeroWrite]:
        return self.store.zero_writes(self.positioner.robot.serial, since=since)

    def _zero_place(self) -> Angles:
        zeros = np.radians([[joint.zero_at_deg for joint in self.positioner.joints]])
        place = complex(forward(self.positioner.robot.geometry, zeros)[0])
        return place.real, place.imag


def shift_of(writes: Sequence[ZeroWrite]) -> Angles:
    """Sum of the shifts by joint: theta before all writes = theta now + shift, deg.

    :raises StepFailed: it is unknown whether a drive accepted its zero.
    """
    shift = [0.0, 0.0]
    for write in writes:
        if write.shift_deg is None:
            raise StepFailed(
                f"Whether joint {write.joint} took the zero of run {write.run_id} cannot be told any more;"
                " calibrate again."
            )
        shift[write.joint - 1] += write.shift_deg
    return shift[0], shift[1]
