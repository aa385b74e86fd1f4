"""Every readout and family of drives, over TCP and RS-485: the true drivers against the emulated rig."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from drivers.driver import Drive
from drivers.emulated.modbus_rtu import framed
from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import parse_rig
from drivers.errors import DeviceFault
from drivers.lines import ModbusBus
from drivers.protocols import LinearScale, ServoAxis
from drivers.scales import SCALES
from drivers.scaling import JointScaling
from drivers.servos import SERVOS
from tests.drivers.wire import rtu
from tests.waiting import soon

FAMILIES = [
    (family, line)
    for family in ("leadshine-el7", "leadshine-cs2rs", "orientalmotor")
    for line in ("tcp", "rtu")
]
PATIENCE_S = 5.0


@contextmanager
def rig_of(family: str, line: str, scale: str = "siko", baud: int = 230_400) -> Iterator[EmulatedRig]:
    text = f'[emulated]\nservo = "{family}"\nline = "{line}"\nscale = "{scale}"\nbaud = {baud}\n'
    with EmulatedRig(parse_rig(text), speed=200) as rig:
        yield rig


@contextmanager
def devices_of(rig: EmulatedRig, **options: object) -> Iterator[tuple[LinearScale, tuple[ServoAxis, ...]]]:
    drives = [Drive(f"servo axis {n}", n, JointScaling(10_000, 20, (n - 1) * 180.0, 1)) for n in (1, 2)]
    servo = SERVOS[rig.servo_options["profile"]]
    settings = servo.settings(url=rig.servo_url, **options)
    axes = tuple(servo.make(settings, drives))
    driver = SCALES[str(rig.scale_options["protocol"])]
    scale = driver.make(driver.settings(**{k: v for k, v in rig.scale_options.items() if k != "protocol"}))
    try:
        for device in (scale, *axes):
            device.connect()
        yield scale, axes
    finally:
        for device in (scale, *axes):
            device.close()


@pytest.mark.parametrize(("family", "line"), FAMILIES)
def test_a_move_a_stop_and_a_zero(family: str, line: str) -> None:
    with rig_of(family, line) as rig, devices_of(rig) as (scale, axes):
        before_mm = scale.read_mm()
        for axis, angle in zip(axes, (10.0, 170.0), strict=True):
            axis.enable()
            axis.move_to(angle, 30.0)
        for axis, angle in zip(axes, (10.0, 170.0), strict=True):
            soon(lambda axis=axis: axis.status().in_position)  # type: ignore[misc]
            assert axis.feedback_deg() == pytest.approx(angle, abs=0.01)
        assert abs(scale.read_mm() - before_mm) > 1.0
        rig.machine.axes[0].put(0.0)
        axes[0].move_to(50.0, 0.5)
        axes[0].quick_stop()
        soon(lambda: not axes[0].status().moving)
        assert not axes[0].status().in_position
        assert axes[0].feedback_deg() < 49.0
        axes[0].preset(0.0)
        assert axes[0].feedback_deg() == pytest.approx(0.0, abs=0.01)
        axes[0].move_to(1.0, 30.0)
        soon(lambda: axes[0].status().in_position)


def test_a_drive_of_another_resolution_is_refused() -> None:
    with rig_of("leadshine-cs2rs", "tcp") as rig:
        bus_url = rig.servo_url
        driver = SERVOS["leadshine-cs2rs"]
        (axis,) = driver.make(
            driver.settings(url=bus_url), [Drive("servo axis 1", 1, JointScaling(4000, 20, 0.0, 1))]
        )
        with pytest.raises(DeviceFault, match="counts 10000 pulses a turn, the station file says 4000"):
            axis.connect()


def test_a_watchdog_stops_a_drive_that_nobody_speaks_to() -> None:
    """The feeder's process dies: here, its line is cut without a word."""
    with rig_of("orientalmotor", "tcp") as rig, devices_of(rig, watchdog_ms=100) as (_, axes):
        for axis in axes:
            axis.enable()
        bus = ModbusBus(rig.servo_url)
        bus.open("another program")
        axis = axes[0]
        axis.move_to(50.0, 0.5)
        for one in axes:
            one._feeder.close()  # type: ignore[attr-defined]
            one._feeder = None  # type: ignore[attr-defined]
        soon(lambda: not rig.machine.axes[0].moving)
        assert axis.status().alarm == 0x85
        axis.reset_alarm()
        assert axis.status().alarm is None
        bus.release("another program")


def test_a_sikos_step_and_its_word_for_a_fault() -> None:
    with rig_of("leadshine-el7", "tcp") as rig, devices_of(rig) as (scale, _):
        value = scale.read_mm()
        assert value == pytest.approx(rig.machine.head_mm(), abs=0.011)
        assert value * 100 == pytest.approx(round(value * 100))
        rig.orders.replace(parse_rig('[[fault]]\ndevice = "scale"\nkind = "contaminated"').orders)
        with pytest.raises(DeviceFault, match="cannot measure"):
            scale.read_mm()


def test_frames_on_rs485_are_those_of_the_manual() -> None:
    assert (
        framed(bytes.fromhex("01 03 00F8 0004"))
        == bytes.fromhex("01 03 00F8 0004 C5F8")
        == rtu("01 03 00F8 0004")
    )


def test_each_family_answers_a_wrong_check_sum_in_its_own_way() -> None:
    """Leadshine with exception 08, as its manual prints; Oriental Motor not at all (p. 240)."""
    for family, answer in (("leadshine-el7", bytes.fromhex("01 83 08 40 F6")), ("orientalmotor", b"")):
        with rig_of(family, "rtu") as rig:
            bus = ModbusBus(rig.servo_url)
            bus.line.open()
            bus.line.write(bytes.fromhex("01 03 00 01 00 01 D5 C1"))
            received = b""
            deadline_s = time.monotonic() + 0.2
            while len(received) < len(answer) and (more := bus.line.read_some(deadline_s)):
                received += more
            assert received == answer
            bus.line.close()
