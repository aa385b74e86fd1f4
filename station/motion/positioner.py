"""From one stop to the next: limits, approach, motion, settling, and a valid reading."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from threading import Event

import numpy as np

from drivers.protocols import ServoAxis
from station.errors import StepFailed, sentence
from station.five_bar import Robot, forward, inverse
from station.mechanism import STILL_DEG, last_senses, needs_run_up
from station.motion.clock import Clock, RunClock
from station.motion.limits import check_way
from station.motion.machine import Machine, NotReady, Pose
from station.records import Angles, Reading, Stop
from station.settings import JointSettings

_POLL_S = 0.01
_LOOK_S = 0.25
"""Interval at which a long motion is monitored with feedback and scale."""
_ARRIVAL_MARGIN_S = 3.0
_SLOWEST_DEG_S = 1.0
_DIGITS = 9
_FROZEN_MM = 1e-6
_MOVED_MM = 5.0

_Samples = tuple[list[float], Angles]
"""Samples of the scale, and the mean feedback."""


class Cancelled(Exception):
    """The run was asked to end."""


@dataclass
class Positioner:
    """Measures stops, one after another, until cancelled."""

    machine: Machine
    robot: Robot
    joints: tuple[JointSettings, JointSettings]
    cancel: Event
    clock: Clock = field(default_factory=RunClock)
    mount: str | None = None
    """Mounting point of the mechanism; None: at the robot file's `c`."""
    _goes_back: bool = False
    """Whether only conditions that forbid any motion stop it."""
    _theta: Angles = (math.nan, math.nan)
    _direction: tuple[int, int] = (0, 0)
    _origin: tuple[float, float] | None = None
    """Scale and nominal distance at the first reading: the origin of the travel."""
    _before: tuple[float, float] | None = None
    """The last sample of the previous reading, and its nominal distance."""

    @property
    def theta_deg(self) -> Angles:
        """Joint angles at the last query."""
        return self._theta

    def prepare(self, *, from_outside: bool = False) -> None:
        """Connect, reset, enable, query, and check every interlock.

        :param from_outside: only the steps that bring the arm back into the workspace
        :raises DeviceError: naming the missing devices or the conditions that forbid a start.
        """
        self.machine.robot, self.machine.compensation_deg = self.robot, (0.0, 0.0)
        self.machine.connect_missing(axes_only=from_outside)
        self.check_cancel()
        self.machine.ready_axes()
        self._goes_back = from_outside
        self.machine.locks.hold_again()
        self.machine.look_around()
        if from_outside:
            with suppress(NotReady):  # outside the workspace its head may be off the scale
                self.machine.connect_missing()
            self._theta = self._feedback()
            return
        self.machine.locks.look_at_reference()
        self.look()
        broken = [f"{lock.text}: {lock.detail}" for lock in self.machine.interlocks() if not lock.ok]
        if broken:
            raise NotReady(f"Not ready to start. {'. '.join(broken)}.")

    def look(self) -> None:
        """Current joint angles, in the present frames of their drives. :raises DeviceError:"""
        self._theta = self.machine.look().theta_deg
        self._origin = self._before = None

    def measure(self, stop: Stop, number: int, sequence: int) -> Reading:
        """Move there and read.

        :raises Cancelled: the run was stopped.
        :raises DeviceError: a device failed.
        :raises StepFailed: a limit forbids the stop, it was not reached, or its reading is not valid.
        """
        self._move_to(stop)
        samples, theta = self._settled() or self._samples(stop, number)
        scale_mm = round(statistics.fmean(samples), _DIGITS)
        self._check_stands(stop, theta)
        self._check_travel(stop, number, samples, theta)
        t_s = round(self.clock.now() * self.machine.devices.speed, 3)
        self.machine.moved(theta, scale_mm)
        return Reading(number, t_s, theta, self._direction, scale_mm, stop.position, sequence, tuple(samples))

    def stand_at(self, stop: Stop) -> None:
        """Move there and come to standstill. :raises: as `measure`."""
        self._move_to(stop)
        self._pause(self.machine.limits.settle_s)

    def _move_to(self, stop: Stop) -> None:
        way = self._way(stop)
        check_way(self.robot, self.joints, self.machine.limits, stop, [self._theta, *way])
        self._check_temperature(stop)
        self.machine.compensation_deg = self._compensation(stop)
        for target in way:
            self._go(stop, target, self.machine.limits.speed_deg_s)

    def go(self, stop: Stop, speed_deg_s: float, *, scale: bool) -> None:
        """Move there directly at a speed, without a check of limits.  :raises: as `measure`

        :param scale: whether the scale is monitored during the motion
        """
        self._go(stop, stop.theta_deg, speed_deg_s, scale=scale)

    # The path -----------------------------------------------------------------------------------

    def _compensation(self, stop: Stop) -> Angles:
        """Compensation that the procedure has subtracted from this stop's command."""
        wanted = np.degrees(inverse(self.robot.geometry, np.array([complex(*stop.target_mm)])))[0]
        return float(wanted[0]) - stop.theta_deg[0], float(wanted[1]) - stop.theta_deg[1]

    def _way(self, stop: Stop) -> list[Angles]:
        """Directly, if that takes up backlash in the requested sense or in any; otherwise after a run-up."""
        run_up = self.machine.limits.overshoot_deg
        target = stop.theta_deg
        way = np.subtract(target, self._theta)
        senses = last_senses(np.array(stop.approach), way)
        if not needs_run_up(senses, way, run_up):
            return [target]
        before = np.subtract(target, run_up * senses)
        return [(float(before[0]), float(before[1])), target]

    # Motion ---------------------------------------------------------------------------------------

    def _go(self, stop: Stop, target: Angles, speed: float, *, scale: bool = True) -> None:
        """Move both joints, timed so that they arrive together."""
        self._check_door(stop)
        start = self._theta
        travel = [abs(end - begin) for begin, end in zip(start, target, strict=True)]
        longest = max(travel)
        for axis, angle, distance in zip(self.machine.devices.axes, target, travel, strict=True):
            self.check_cancel()
            share = speed * distance / longest if longest else speed
            with self.machine.using(axis):
                axis.move_to(angle, max(share, min(speed, _SLOWEST_DEG_S)))
        self._wait_in_position(stop, start, target, longest / speed + _ARRIVAL_MARGIN_S, scale)
        theta = self._feedback()
        for joint in (0, 1):
            if not abs(theta[joint] - target[joint]) <= self.machine.limits.feedback_deg:
                raise self.machine.trip(
                    "following_error",
                    f"At position {stop.position} joint {joint + 1} stands at {theta[joint]:.4f} deg"
                    f" instead of {target[joint]:.4f}.",
                )
        self._direction = (
            _direction(theta[0] - start[0], self._direction[0]),
            _direction(theta[1] - start[1], self._direction[1]),
        )
        self._theta = theta

    def _wait_in_position(
        self, stop: Stop, start: Angles, target: Angles, limit_s: float, scale: bool
    ) -> None:
        now = self.clock.now()
        deadline, next_look = now + limit_s, now + _LOOK_S
        while True:
            self.check_cancel()
            self._check_door(stop)
            # Check both each time: one that has arrived may still raise an alarm while the other moves.
            waiting = [axis for axis in self.machine.devices.axes if not self._arrived(stop, axis)]
            if not waiting:
                return
            now = self.clock.now()
            if now > deadline:
                names = " and ".join(axis.name for axis in waiting)
                raise self.machine.trip(
                    "following_error",
                    f"{sentence(names)} did not reach position {stop.position} within {limit_s:.1f} s.",
                )
            if now > next_look:
                self._check_temperature(stop)
                self._check_corridor(stop, start, target, scale)
                next_look = now + _LOOK_S
            self._wait(_POLL_S)

    def _arrived(self, stop: Stop, axis: ServoAxis) -> bool:
        status = self.machine.status(axis)
        if status.alarm is not None:
            raise self.machine.trip(
                "drives",
                f"{sentence(axis.name)} shows alarm {status.alarm:X}h on the way to position {stop.position};"
                " find its cause, the next run resets it.",
            )
        if not status.enabled:
            raise self.machine.trip(
                "drives", f"{sentence(axis.name)} lost its power on the way to position {stop.position}."
            )
        return status.in_position and not status.moving

    def _check_corridor(self, stop: Stop, start: Angles, target: Angles, scale: bool) -> None:
        """Each joint stays between its start and its target; the scale remains readable, and moves
        consistently.
        """
        pose = self.machine.look() if scale else None
        theta = self._feedback()
        room = self.machine.locks.following_error_deg
        for joint in (0, 1):
            low, high = sorted((start[joint], target[joint]))
            if not low - room <= theta[joint] <= high + room:
                raise self.machine.trip(
                    "following_error",
                    f"Joint {joint + 1} left its way to position {stop.position}: it is at"
                    f" {theta[joint]:.3f} deg.",
                )
        if pose is not None and self._origin is not None:
            self._check_moving_scale(stop, pose, theta)

    def _check_moving_scale(self, stop: Stop, before: Pose, after: Angles) -> None:
        """The scale reading lies between the values computed from the joints before and after it."""
        assert self._origin is not None
        if not math.isfinite(before.scale_mm):
            raise self.machine.trip(
                "scale", f"On the way to position {stop.position} the scale does not give a number."
            )
        travel = before.scale_mm - self._origin[0]
        low, high = sorted(self._distance(theta) - self._origin[1] for theta in (before.theta_deg, after))
        doubt = max(low - travel, travel - high)
        if not doubt <= self.machine.locks.travel_error_mm:
            raise self.machine.trip(
                "travel",
                f"On the way to position {stop.position} the scale moved {doubt:.1f} mm beside what the"
                " joints say; check its rod and channel.",
            )

    def _check_door(self, stop: Stop) -> None:
        if trouble := self.machine.locks.look_at_guard_door():
            text = f"Guard door, on the way to position {stop.position}: {trouble}."
            raise self.machine.trip("guard_door", text)

    def _check_temperature(self, stop: Stop) -> None:
        if not self._goes_back and (trouble := self.machine.locks.look_at_temperature()):
            text = f"Temperature, on the way to position {stop.position}: {trouble}."
            raise self.machine.trip("temperature", text)

    # Reading --------------------------------------------------------------------------------------

    def _settled(self) -> _Samples | None:
        """The first samples that agree; None if none do within the longest wait.

        No wait is longer than the former fixed pause: a machine that still moves then is judged as before.
        """
        limits = self.machine.limits
        until = self.clock.now() + limits.settle_s / self.machine.devices.speed
        scale: list[float] = []
        angles: list[Angles] = []
        while len(scale) < limits.samples or self.clock.now() < until:
            self._sample(scale, angles)
            last = scale[-limits.samples :]
            if not math.isfinite(scale[-1]):
                return None
            if len(last) == limits.samples and max(last) - min(last) <= limits.settled_mm:
                return last, _mean(angles[-limits.samples :])
        return None

    def _samples(self, stop: Stop, number: int) -> _Samples:
        """Scale samples that agree with each other, and the mean feedback; one second attempt."""
        spread = 0.0
        for _ in range(2):
            scale: list[float] = []
            angles: list[Angles] = []
            for _ in range(self.machine.limits.samples):
                self._sample(scale, angles)
            if not all(math.isfinite(value) for value in scale):
                raise self.machine.trip(
                    "scale", f"Reading {number} at position {stop.position} is not a number."
                )
            spread = max(scale) - min(scale)
            if spread <= self.machine.limits.scale_spread_mm:
                return scale, _mean(angles)
            self._pause(self.machine.limits.settle_s)
        raise StepFailed(
            f"Reading {number} at position {stop.position} does not settle: its samples spread"
            f" {spread:.4f} mm, {self.machine.limits.scale_spread_mm:g} mm is allowed."
        )

    def _sample(self, scale: list[float], angles: list[Angles]) -> None:
        self.check_cancel()
        with self.machine.using(self.machine.devices.scale):
            scale.append(self.machine.devices.scale.read_mm())
        angles.append(self._feedback())

    def _feedback(self) -> Angles:
        angles = []
        for axis in self.machine.devices.axes:
            with self.machine.using(axis):
                angles.append(axis.feedback_deg())
        return angles[0], angles[1]

    def _check_stands(self, stop: Stop, theta: Angles) -> None:
        """Both drives held their position while the scale was read: one that restarted did not."""
        for axis in self.machine.devices.axes:
            self._arrived(stop, axis)
        for joint in (0, 1):
            if not abs(theta[joint] - stop.theta_deg[joint]) <= self.machine.limits.feedback_deg:
                raise self.machine.trip(
                    "following_error",
                    f"While position {stop.position} was read, joint {joint + 1} came to stand at"
                    f" {theta[joint]:.4f} deg instead of {stop.theta_deg[joint]:.4f};"
                    " has its drive restarted?",
                )

    def _check_travel(self, stop: Stop, number: int, samples: Sequence[float], theta: Angles) -> None:
        """The scale must have moved about as far as computed from the joints: a slipped rod does not.

        It must also have moved at all: a frozen readout continues to answer.
        """
        distance = self._distance(theta)
        scale_mm = statistics.fmean(samples)
        if self._before is not None:
            stood = abs(samples[0] - self._before[0]) < _FROZEN_MM
            if stood and abs(distance - self._before[1]) > _MOVED_MM:
                raise self.machine.trip(
                    "travel",
                    f"Reading {number} at position {stop.position} is implausible: the scale shows"
                    f" {scale_mm:.4f} mm as before, although the joints moved; check its display and rod.",
                )
        self._before = (samples[-1], distance)
        if self._origin is None:
            self._origin = (scale_mm, distance)
        doubt = (scale_mm - self._origin[0]) - (distance - self._origin[1])
        if not abs(doubt) <= self.machine.locks.travel_error_mm:
            raise self.machine.trip(
                "travel",
                f"Reading {number} at position {stop.position} is implausible: the scale moved"
                f" {doubt:+.1f} mm more than the joints say; check its rod and channel.",
            )

    def _distance(self, theta: Angles) -> float:
        """From the foot of the mechanism to P, mm, by the nominal geometry."""
        foot = complex(*(self.robot.mount_of(self.mount or "") or self.robot.c)) + complex(*self.robot.d)
        return float(abs(forward(self.robot.geometry, np.radians(np.array([theta])))[0] - foot))

    def _pause(self, machine_s: float) -> None:
        """Wait for seconds of the machine's own time."""
        self._wait(machine_s / self.machine.devices.speed)

    def _wait(self, seconds: float) -> None:
        if self.clock.wait(self.cancel, seconds):
            raise Cancelled

    def check_cancel(self) -> None:
        """:raises Cancelled: the run was stopped."""
        if self.cancel.is_set():
            raise Cancelled


def _mean(angles: Sequence[Angles]) -> Angles:
    return (
        round(statistics.fmean(pair[0] for pair in angles), _DIGITS),
        round(statistics.fmean(pair[1] for pair in angles), _DIGITS),
    )


def _direction(travel_deg: float, before: int) -> int:
    """Sign of a motion; a motion too small to have a direction retains the previous one."""
    if abs(travel_deg) <= STILL_DEG:
        return before
    return 1 if travel_deg > 0 else -1
