"""The devices as one machine: state of each, position of the arm, conditions that forbid motion."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

import numpy as np

from drivers.errors import DeviceError, DeviceFault
from drivers.lines import Traffic, line_of
from drivers.protocols import AxisStatus, Device, ServoAxis
from station.five_bar import Robot, Unreachable, forward
from station.interlock_settings import InterlockSettings
from station.motion.devices import Devices
from station.motion.events import Listeners
from station.motion.interlocks import Interlocks, Tripped
from station.motion.limits import outside_text
from station.motion.time_limit import each_within
from station.motion.way_back import outside_mm
from station.records import (
    CalibrationHolds,
    DeviceDetail,
    DeviceState,
    DeviceView,
    Interlock,
    MachineView,
    RetractView,
    Trip,
)
from station.settings import LimitSettings

STOP_LIMIT_S = 1.5
STANDSTILL_LIMIT_S = 3.0
CLOSE_LIMIT_S = 2.0
_REST_POLL_S = 0.02


class NotReady(DeviceError):
    """Conditions forbid a start; the text lists all of them."""


@dataclass(frozen=True, slots=True)
class Pose:
    """Position of the arm at a time of the monotonic clock."""

    theta_deg: tuple[float, float]
    scale_mm: float
    at: float


@dataclass(slots=True)
class _Known:
    connected: bool = False
    state: DeviceState = "unknown"
    text: str = "not connected yet"
    alarm: int | None = None
    heard_at: float | None = None
    """Time by the monotonic clock."""
    errors: int = 0


class Machine:
    """Scale and two axes. One thread works with it; any thread may call `quick_stop` and the views."""

    def __init__(
        self,
        devices: Devices,
        limits: LimitSettings,
        listeners: Listeners,
        interlocks: InterlockSettings,
        reference: Callable[[str], CalibrationHolds] | None = None,
    ) -> None:
        """:param reference: result of the checks of a robot; None: not used"""
        self.devices = devices
        self.limits = limits
        self.locks = Interlocks(interlocks, limits, devices.read_register, reference)
        self.robot = Robot.default()
        """The robot whose geometry converts joint angles to a position."""
        self.compensation_deg = (0.0, 0.0)
        """Zero offsets found so far by the run; added to a displayed position, never to a judged one."""
        self._listeners = listeners
        self._all: tuple[Device, ...] = (devices.scale, *devices.axes)
        self._known = {device.name: _Known() for device in self._all}
        self._pose: Pose | None = None
        self._stands_deg: tuple[float, float] | None = None
        """As in the pose; also known without the scale."""
        self._published: tuple[Interlock, ...] = ()
        self._failed: Device | None = None
        """The device whose use failed last."""
        self._stop_frames_at_s: float | None = None
        self._published_retract: RetractView | None = None

    # Working with the devices --------------------------------------------------------------------

    @contextmanager
    def using(self, device: Device) -> Iterator[None]:
        """Context of any use of a device: its state is stored and published."""
        try:
            yield
        except DeviceError as error:
            works = isinstance(error, DeviceFault)
            self._known[device.name].errors += 1
            self._failed = device
            self._known[device.name].connected &= works
            self._learn(device, "fault" if works else "lost", str(error))
            raise
        else:
            self._known[device.name].heard_at = time.monotonic()
            if self._known[device.name].alarm is None:
                self._learn(device, "ok", "")

    def release(self) -> None:
        """Close every device; the next use connects it again."""
        for device in self._all:
            device.close()
            self._known[device.name].connected = False

    def connect_missing(self, *, axes_only: bool = False) -> None:
        """Connect every device that was never connected or was lost.

        :raises NotReady: listing all devices that could not be connected, each with its cause.
        """
        failures = []
        for device in self.devices.axes if axes_only else self._all:
            if self._known[device.name].connected:
                continue
            device.close()
            try:
                with self.using(device):
                    device.connect()
                    self._known[device.name].connected = True
            except DeviceError as error:
                failures.append(str(error))
        if failures:
            raise NotReady(" ".join(failures))

    def status(self, axis: ServoAxis) -> AxisStatus:
        """An axis's status; its alarm is stored. :raises DeviceError:"""
        with self.using(axis):
            status = axis.status()
            self._known[axis.name].alarm = status.alarm
        if status.alarm is not None:
            self._learn(axis, "fault", f"alarm {status.alarm:X}h")
        return status

    def look(self) -> Pose:
        """Read the position of the arm. :raises DeviceError:"""
        angles = []
        for axis in self.devices.axes:
            with self.using(axis):
                angles.append(axis.feedback_deg())
        with self.using(self.devices.scale):
            scale_mm = self.devices.scale.read_mm()
        return self.moved((angles[0], angles[1]), scale_mm)

    def moved(self, theta_deg: tuple[float, float], scale_mm: float) -> Pose:
        """Store and publish the current position of the arm."""
        pose = self._pose = Pose(theta_deg, scale_mm, time.monotonic())
        self._stands_deg = theta_deg
        self._listeners.publish("machine", self.view())
        self._tell_interlocks()
        return pose

    def watch(self) -> None:
        """One query while no run is active: connect missing devices, read the others."""
        self.locks.hold_again()
        try:
            self.connect_missing()
            for axis in self.devices.axes:
                self.status(axis)
            self.look_around()
            self.look()
        except DeviceError:
            self._pose = None  # an unknown position is not shown
            self._look_at_axes()
            if self._stands_deg is None:
                self.locks.forget()
            self._tell_interlocks()

    def look_around(self) -> None:
        """Guard door and temperature, if the station file defines them."""
        self.locks.look_at_guard_door()
        self.locks.look_at_temperature()

    def _look_at_axes(self) -> None:
        """The position of the arm is known without the scale: enough to bring it back."""
        self._stands_deg = None
        if not all(self._known[axis.name].connected for axis in self.devices.axes):
            return
        angles = []
        try:
            for axis in self.devices.axes:
                with self.using(axis):
                    angles.append(axis.feedback_deg())
        except DeviceError:
            return
        self._stands_deg = (angles[0], angles[1])

    def ready_axes(self) -> None:
        """Reset alarms that can be reset and power both axes. :raises DeviceError:"""
        for axis in self.devices.axes:
            status = self.status(axis)
            with self.using(axis):
                if status.alarm is not None:
                    axis.reset_alarm()
                    self._known[axis.name].alarm = None
                if status.alarm is not None or not status.enabled:
                    axis.enable()

    def mounted_at(self, c: tuple[float, float], mounting: int = 0) -> None:
        """A person has mounted the mechanism there, mm; with the emulated machine this call does it.

        :param mounting: 1, 2, ... if it is remounted there
        """
        if self.devices.remount is not None:
            self.devices.remount(c, mounting)

    # Stopping ------------------------------------------------------------------------------------

    def quick_stop(self) -> dict[str, str | None]:
        """Stop both axes now, from any thread; by axis None or the error."""
        return each_within(STOP_LIMIT_S, {axis.name: axis.quick_stop for axis in self.devices.axes})

    def make_safe(self, *, insist: bool = True) -> str | None:
        """Make every device safe, and stop both axes until they report standstill.

        :param insist: whether to repeat until standstill; otherwise one attempt is enough, as before the
        first motion.
        :return: None, or a sentence about the part that could not be confirmed.
        """
        each_within(STOP_LIMIT_S, {device.name: device.make_safe for device in self._all})
        self._stop_frames_at_s = self._stop_frames_sent_at_s()
        return self._rest(self.devices.axes, STANDSTILL_LIMIT_S if insist else 0.0)

    def standstill(self) -> str | None:
        """Wait until both axes report standstill. None, or a sentence that it is not confirmed."""
        return self._rest((), STANDSTILL_LIMIT_S)

    def _rest(self, to_stop: tuple[ServoAxis, ...], limit_s: float) -> str | None:
        deadline = time.monotonic() + limit_s
        while True:
            # A line may recover during this wait: a stop that was not confirmed is sent again.
            trouble = each_within(STOP_LIMIT_S, {axis.name: axis.quick_stop for axis in to_stop})
            to_stop = tuple(axis for axis in to_stop if trouble[axis.name])
            looks = {axis.name: partial(_expect_standstill, axis) for axis in self.devices.axes}
            doubts = {name: text for name, text in each_within(STOP_LIMIT_S, looks).items() if text}
            if not doubts:
                return None
            if time.monotonic() >= deadline:
                said = "; ".join(f"{name}: {text.rstrip('.')}" for name, text in doubts.items())
                return f"Standstill could not be confirmed, look at the arm ({said})."
            time.sleep(_REST_POLL_S)

    def _stop_frames_sent_at_s(self) -> float | None:
        """Time at which the later of both drives was sent its last stop; None if one never was."""
        lines = {id(line): line for axis in self.devices.axes if (line := line_of(axis)) is not None}
        sent = [at_s for line in lines.values() for at_s in line.traffic.stop_sent_at_s.values()]
        return max(sent) if len(sent) == len(self.devices.axes) else None

    def close(self) -> None:
        """Release all lines."""
        each_within(CLOSE_LIMIT_S, {device.name: device.close for device in self._all})

    # State --------------------------------------------------------------------------------------

    def view(self) -> MachineView | None:
        """The `machine` part of the snapshot; None while the position is unknown."""
        pose = self._pose
        if pose is None:
            return None
        place = self.shown_place(pose.theta_deg)
        return MachineView(
            theta1_deg=pose.theta_deg[0],
            theta2_deg=pose.theta_deg[1],
            x_mm=place and place[0],
            y_mm=place and place[1],
            scale_mm=pose.scale_mm if math.isfinite(pose.scale_mm) else None,
            age_s=round(time.monotonic() - pose.at, 3),
        )

    def shown_place(self, theta_deg: tuple[float, ...]) -> tuple[float, float] | None:
        """x, y in mm for display: includes the known zero offsets; None as in `place`."""
        return self.place(tuple(map(sum, zip(theta_deg, self.compensation_deg, strict=True))))

    def place(self, theta_deg: tuple[float, ...]) -> tuple[float, float] | None:
        """Nominal x, y in mm of joint angles; None if the linkage does not close."""
        try:
            point = forward(self.robot.geometry, np.radians(np.array([theta_deg])))[0]
        except Unreachable:
            return None
        return float(point.real), float(point.imag)

    def device_views(self) -> tuple[DeviceView, ...]:
        """The `devices` part of the snapshot."""
        return tuple(self._device_view(device) for device in self._all)

    def _device_view(self, device: Device) -> DeviceView:
        index = self._all.index(device)
        known = self._known[device.name]
        return DeviceView(
            name=device.name,
            kind="scale" if index == 0 else "axis",
            address=self.devices.addresses[index],
            state=known.state,
            text=known.text,
        )

    def device_details(self) -> tuple[DeviceDetail, ...]:
        """The same for maintenance.  Never waits for a device."""
        return tuple(self._device_detail(device) for device in self._all)

    def _device_detail(self, device: Device) -> DeviceDetail:
        known, line = self._known[device.name], line_of(device)
        traffic = line.traffic if line is not None else Traffic()
        said = getattr(device, "identity", "")
        trip_s = traffic.last_round_trip_s
        return DeviceDetail(
            **dict(self._device_view(device)),
            identity=said if isinstance(said, str) else " ".join(said),
            heard_s=None if known.heard_at is None else round(time.monotonic() - known.heard_at, 1),
            errors=known.errors,
            round_trip_ms=None if trip_s is None else round(1000 * trip_s, 2),
            requests=traffic.requests,
            replies=traffic.replies,
        )

    # Interlocks ----------------------------------------------------------------------------------

    def trip(self, interlock: str, text: str) -> Tripped:
        """The error for an interlock that was violated during motion: published, and to be raised."""
        tripped = self.locks.trip(interlock, text)
        self._tell_interlocks()
        return tripped

    def trip_by(self, error: DeviceError, text: str) -> Tripped:
        """The same for a device that failed during motion."""
        if not isinstance(error, DeviceFault):
            return self.trip("devices", text)
        return self.trip("scale" if self._failed is self.devices.scale else "drives", text)

    def came_to_rest(self, run: int, tripped: Tripped) -> Trip:
        """Record how long the stop took, after the motion that an interlock ended."""
        sent_at_s = self._stop_frames_at_s
        trip = Trip(
            run=run,
            text=str(tripped),
            stop_frame_ms=None if sent_at_s is None else _ms(sent_at_s - tripped.noticed_at_s),
            standstill_ms=_ms(time.monotonic() - tripped.noticed_at_s),
        )
        self.locks.ended(tripped, trip)
        self._tell_interlocks()
        return trip

    def interlocks(self) -> tuple[Interlock, ...]:
        """Conditions before and during motion, as data."""
        missing = [name for name, known in self._known.items() if not known.connected]
        alarms = [
            f"{name}: alarm {known.alarm:X}h; the next run tries to reset it"
            for name, known in self._known.items()
            if known.alarm is not None
        ]
        scale_mm = self._pose.scale_mm if self._pose else math.nan
        known = {
            "devices": "no answer: " + ", ".join(missing) if missing else "",
            "drives": "; ".join(alarms),
            "workspace": self._outside(),
            "scale": "" if math.isfinite(scale_mm) else "no reading",
        }
        return self.locks.views(known, self.robot.serial)

    def retract(self) -> RetractView:
        """The `retract` part of the snapshot."""
        if self._stands_deg is None:
            return RetractView(needed=False, excess_mm=None, text="It is not known where the arm stands.")
        excess_mm = outside_mm(self.robot, self._stands_deg)
        if not math.isfinite(excess_mm):
            return RetractView(
                needed=True, excess_mm=None, text="The linkage cannot close at these joint angles."
            )
        if excess_mm <= self.limits.workspace_margin_mm:
            return RetractView(
                needed=False,
                excess_mm=max(0.0, round(excess_mm, 3)),
                text="The arm stands within its workspace.",
            )
        return RetractView(
            needed=True,
            excess_mm=round(excess_mm, 3),
            text=f"The arm stands {excess_mm:.1f} mm outside its workspace.",
        )

    def _outside(self) -> str:
        if self._pose is None:
            return "its place is not known"
        place = self.place(self._pose.theta_deg)
        if place is None:
            return "the linkage cannot close at these joint angles"
        return outside_text(self.robot, complex(*place), self.locks.outside_mm)

    def _learn(self, device: Device, state: DeviceState, text: str) -> None:
        known = self._known[device.name]
        if (known.state, known.text) == (state, text):
            return
        known.state, known.text = state, text
        self._listeners.publish("device", self._device_view(device))
        self._tell_interlocks()

    def _tell_interlocks(self) -> None:
        interlocks = self.interlocks()
        if [lock.without_value() for lock in interlocks] != [
            lock.without_value() for lock in self._published
        ]:
            self._published = interlocks
            self._listeners.publish("interlock", interlocks)
        retract = self.retract()
        if retract != self._published_retract:
            self._published_retract = retract
            self._listeners.publish("retract", retract)


def _expect_standstill(axis: ServoAxis) -> None:
    if axis.status().moving:
        raise DeviceFault("still moves")


def _ms(seconds: float) -> float:
    return round(1000 * seconds, 1)
