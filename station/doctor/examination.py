"""Examination of all devices, one after another, without motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress

from drivers.errors import DeviceError
from drivers.lines import SerialLine, line_of
from drivers.protocols import Device, LinearScale, ServoAxis
from station.doctor.finding import Finding
from station.doctor.ports import examine_port
from station.doctor.round_trips import RoundTrips
from station.doctor.swapped import axes_exchanged, lines_exchanged
from station.five_bar import Robot
from station.motion import Devices, Interlocks, outside_mm
from station.settings import Settings

_LOOKS = 5


def examine(settings: Settings, devices: Devices, robot: Robot) -> Finding:
    """A tree with one branch for each device.  Every device is closed afterwards."""
    return _examined(settings, devices, robot, _examine_device)


def _examined(
    settings: Settings, devices: Devices, robot: Robot, one: Callable[[Device, Finding, bool], float | None]
) -> Finding:
    tree = Finding(settings.name + (", emulated" if devices.emulated else ""))
    scale = tree.add(f"{devices.scale.name} at {devices.addresses[0]}")
    scale_mm = one(devices.scale, scale, devices.emulated)
    angles: list[float | None] = []
    for axis, address in zip(devices.axes, devices.addresses[1:], strict=True):
        angles.append(one(axis, tree.add(f"{axis.name} at {address}"), devices.emulated))
    if None not in (scale_mm, *angles):
        _examine_arm(settings, robot, [angle for angle in angles if angle is not None], tree)
    elif not devices.emulated and (text := lines_exchanged(settings)):
        tree.add(text, "trouble", "exchange the two addresses in the station file, or the plugs")
    _examine_interlocks(settings, devices, robot, tree)
    return tree


def _examine_interlocks(settings: Settings, devices: Devices, robot: Robot, tree: Finding) -> None:
    """Each interlock with its limits; guard door and thermometer are read if they are configured."""
    branch = tree.add("interlocks")
    locks = Interlocks(settings.interlocks, settings.limits, devices.read_register)
    if settings.interlocks.reads_registers:
        drive, line = devices.axes[0], line_of(devices.axes[0])
        opened = line is None or not line.is_open
        with suppress(DeviceError):  # the branch of the drive states the cause
            if opened:
                drive.connect()
            locks.look_at_guard_door()
            locks.look_at_temperature()
        if opened:
            drive.close()
    for lock in locks.views({}, robot.serial):
        limits = _in_words(lock.limits)
        said = f"{lock.text}{f' ({limits})' if limits else ''}{f': {lock.shows}' if lock.shows else ''}"
        if lock.ok:
            branch.add(said)
        else:
            do = f"if that is not so, check [interlocks.{lock.id}] in the station file"
            branch.add(f"{said}: {lock.detail}", "trouble", do)


def _in_words(limits: dict[str, float]) -> str:
    """Limits of an interlock with their units, in the form of the page."""
    window = [f"{limits['low_c']:g} to {limits['high_c']:g} °C"] if "low_c" in limits else []
    most = [(name, value) for name, value in limits.items() if name not in ("low_c", "high_c")]
    return ", ".join(
        [*window, *(f"at most {value:g} {'°' if name.endswith('_deg') else 'mm'}" for name, value in most)]
    )


def examine_in_service(settings: Settings, devices: Devices, robot: Robot) -> Finding:
    """The same while a station uses its devices, on the thread that does.

    Devices that answer stay open, so that a stop never waits for a connection; only a device whose line is
    down is examined from its port on, and closed again.
    """
    return _examined(settings, devices, robot, _examine_open)


def _examine_open(device: Device, branch: Finding, emulated: bool) -> float | None:
    line = line_of(device)
    if line is None or not line.is_open:
        return _examine_device(device, branch, emulated)
    try:
        return _look(device, line, branch)
    except DeviceError as error:
        branch.add(str(error), "trouble")
        return None


def _examine_device(device: Device, branch: Finding, emulated: bool) -> float | None:
    """Its value, mm or deg; None where it cannot be read."""
    line = line_of(device)
    if line is None or not examine_port(line, branch, emulated=emulated):
        return None
    try:
        device.connect()
    except DeviceError as error:
        branch.add(str(error), "trouble")  # a driver's sentence states what to check
        return None
    try:
        return _look(device, line, branch)
    except DeviceError as error:
        branch.add(str(error), "trouble", "this device was there and failed: look at its line for noise")
        return None
    finally:
        device.close()


def _look(device: Device, line: SerialLine, branch: Finding) -> float:
    if identity := getattr(device, "identity", ""):
        branch.add(f"identifies itself as {identity if isinstance(identity, str) else ' '.join(identity)}")
    value = math.nan
    with RoundTrips(line) as trips:
        for _ in range(_LOOKS):
            if isinstance(device, LinearScale):
                value = device.read_mm()
            elif isinstance(device, ServoAxis):
                value = device.feedback_deg()
    branch.add(f"answers: {trips.text}")
    if isinstance(device, ServoAxis):
        branch.add(f"stands at {value:.4f} deg")
        _tell_status(device, branch)
    else:
        branch.add(f"reads {value:.4f} mm")
    return value


def _tell_status(axis: ServoAxis, branch: Finding) -> None:
    status = axis.status()
    if status.alarm is not None:
        branch.add(
            f"shows alarm {status.alarm:X}h",
            "trouble",
            "find its cause in the maker's manual; the next run resets it",
        )
    if status.moving:
        branch.add("moves, although this program moves nothing", "trouble", "find out who moves it")
    branch.add("is powered" if status.enabled else "is not powered; a run powers it")


def _examine_arm(settings: Settings, robot: Robot, theta_deg: Sequence[float], tree: Finding) -> None:
    arm = tree.add("the arm")
    here = (theta_deg[0], theta_deg[1])
    excess_mm = outside_mm(robot, here)
    if excess_mm <= 0:
        arm.add("stands within its workspace")
        return
    far = excess_mm > settings.limits.swing_mm
    where = f"stands {excess_mm:.1f} mm outside its workspace"
    if not math.isfinite(excess_mm):
        where = "cannot stand where the drives say: the linkage does not close"
    if axes_exchanged(settings, robot, here):
        arm.add(
            f"{where}; with the drives exchanged it would be within",
            "trouble" if far else "note",
            "compare with the arm; if it stands elsewhere, exchange the units of the two [[servo.joint]]",
        )
    else:
        arm.add(where, "trouble" if far else "note", "compare with the arm; `station retract` brings it back")
