"""New zeros for the drives: go to the place, declare it, read it back, with a journal that survives a crash.

A drive can only declare the place where it stands to be its zero.  What the servo stands beside its
command goes into the journal with the rest, so the frame of every later angle is known to the pulse.
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

READ_BACK_PULSES = 1.0
SETTLE_PULSES = 20.0
"""How near the feedback must be to one of the two places it can be at after a write that was cut off."""


@dataclass
class Zeroing:
    """Writes the zeros of one run."""

    run_id: int
    machine: Machine
    positioner: Positioner
    store: Store

    def settle(self) -> None:
        """Before anything moves: did the drives take what was being written when something broke off?

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
        """Bring each joint to where its zero shall be and declare it; the shifts since run `step.of`, deg.

        A joint that is to get its old zero back and never lost it is left alone.

        :raises Cancelled: stop was pressed; what was written until then is in the journal.
        :raises DeviceError: a device failed.
        :raises StepFailed: the place is out of limits, not reached, or the zero reads back different.
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
                with suppress(DeviceError):  # the next run looks again
                    self.settle()
                raise
            self.positioner.look()
        return shift_of(self._writes(step.of))

    def _check_powered(self) -> None:
        """The run has powered both drives.  One that lost its power since may count from elsewhere, and what
        is written then has nothing to do with the zero that it is to have.

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

    :raises StepFailed: it is not known whether a drive took its zero.
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
