"""Both drivers on the emulated rig: real pseudo-terminal, real TCP, every scripted fault."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest
import serial

from drivers.emulated.rig import EmulatedRig, StateFileError
from drivers.emulated.rig_file import DEFAULT_RIG, load_rig
from drivers.emulated.spec import Fault, FaultKind, MachineSpec, RigSpec
from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines.modbus import ModbusBus
from drivers.scales.heidenhain_nd import HeidenhainND
from drivers.scaling import JointScaling
from drivers.servos.leadshine_el7 import LeadshineEL7
from tests.waiting import soon

PATIENCE_S = 10.0
ZERO_AT_DEG = (0.0, 180.0)
Axes = tuple[LeadshineEL7, LeadshineEL7]


def connected_axes(rig: EmulatedRig) -> Axes:
    bus = ModbusBus(rig.servo_url)
    first, second = (
        LeadshineEL7(bus, i + 1, JointScaling(10_000, 20, ZERO_AT_DEG[i], 1), name=f"servo axis {i + 1}")
        for i in (0, 1)
    )
    for axis in (first, second):
        axis.connect()
        axis.enable()
    return first, second


@pytest.fixture
def axes(rig: EmulatedRig) -> Iterator[Axes]:
    both = connected_axes(rig)
    yield both
    for axis in both:
        axis.make_safe()
        axis.close()


@pytest.fixture
def scale(rig: EmulatedRig) -> Iterator[HeidenhainND]:
    display = HeidenhainND(rig.scale_url, timeout_s=0.15)
    display.connect()
    yield display
    display.close()


def go(axes: Axes, theta1_deg: float, theta2_deg: float) -> None:
    axes[0].move_to(theta1_deg, 20.0)
    axes[1].move_to(theta2_deg, 20.0)
    soon(lambda: all(axis.status().in_position for axis in axes))


def test_a_walk_measures_what_the_machine_is(rig: EmulatedRig, axes: Axes, scale: HeidenhainND) -> None:
    for target in ((12.0, 170.0), (-8.0, 185.0), (0.0, 180.0)):
        go(axes, *target)
        for axis, theta_deg in zip(axes, target, strict=True):
            assert axis.feedback_deg() == pytest.approx(theta_deg, abs=0.015)
        x, y = rig.machine.point_mm()
        rho_mm = ((x - 1.0) ** 2 + (y + 130 - 0.5) ** 2) ** 0.5
        assert scale.read_mm() == pytest.approx(rho_mm - 437.25, abs=0.01)


def test_two_stations_cannot_share_the_scale(rig: EmulatedRig, scale: HeidenhainND) -> None:
    with pytest.raises(LinkLost, match="another program holds it"):
        HeidenhainND(rig.scale_url).connect()


def test_quick_stop_halts_a_move() -> None:
    with EmulatedRig(load_rig(DEFAULT_RIG), speed=1.0) as rig:
        axes = connected_axes(rig)
        axes[0].move_to(40.0, 10.0)
        assert axes[0].status().moving
        axes[0].quick_stop()
        soon(lambda: not axes[0].status().moving)
        assert not axes[0].status().in_position
        assert axes[0].feedback_deg() < 39.0
        for axis in axes:
            axis.close()


def test_a_stop_gets_through_although_nobody_is_connected(rig: EmulatedRig) -> None:
    bus = ModbusBus(rig.servo_url)
    sent: list[bytes] = []
    bus.line.recorder = lambda what, data: sent.append(data) if what == "tx" else None
    axis = LeadshineEL7(bus, 1, JointScaling(10_000, 20, 0.0, 1), name="servo axis 1")
    axis.make_safe()
    stop, look = bytes.fromhex("01 06 6002 0040"), bytes.fromhex("01 03 0B05 0001")
    assert [frame[6:] for frame in sent] == [stop, look]


def test_preset_moves_the_zero(rig: EmulatedRig, axes: Axes) -> None:
    """Joint 1 is 2 deg beside its drive: moved to -2 deg it stands at 0, and that is then declared."""
    go(axes, -2.0, 181.0)
    axes[0].preset(0.0)
    axes[1].preset(180.0)
    assert [axis.zero_offset_deg for axis in rig.machine.axes] == pytest.approx([0.0, 0.0], abs=0.012)
    go(axes, 0.0, 180.0)
    assert rig.machine.point_mm() == pytest.approx((0.0, -688.2), abs=0.5)


def test_drives_start_where_they_were_left(tmp_path: Path) -> None:
    state_file = tmp_path / "place.json"
    spec = load_rig(DEFAULT_RIG)
    with EmulatedRig(spec, speed=500, state_file=state_file) as rig:
        axes = connected_axes(rig)
        go(axes, 9.0, 171.0)
        left = [axis.feedback_deg() for axis in axes]
        for axis in axes:
            axis.close()
    with EmulatedRig(spec, state_file=state_file) as rig:
        axes = connected_axes(rig)
        assert [axis.feedback_deg() for axis in axes] == left
        for axis in axes:
            axis.close()


def test_a_damaged_state_file_is_refused(tmp_path: Path) -> None:
    state_file = tmp_path / "place.json"
    state_file.write_text('{"shaft_pulses": [1]}')
    with (
        pytest.raises(StateFileError, match="is damaged; delete it"),
        EmulatedRig(RigSpec(), state_file=state_file),
    ):
        pass


def test_a_state_file_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    with (
        pytest.raises(StateFileError, match="cannot be written"),
        EmulatedRig(RigSpec(), state_file=tmp_path / "nowhere" / "place.json"),
    ):
        pass


def test_the_display_waits_between_xoff_and_xon(rig: EmulatedRig) -> None:
    with serial.Serial(rig.scale_url.split("//")[1].split("?")[0], timeout=0.1) as port:
        port.write(b"\x13\x02")
        assert port.read(17) == b""
        port.write(b"\x11")
        port.timeout = PATIENCE_S
        assert port.read(17).startswith(b"+  111.6")


# -- scripted wire faults --------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["scale_silent", "scale_garbled", "scale_late"])
def test_one_bad_scale_reply_is_overcome(rig: EmulatedRig, scale: HeidenhainND, kind: FaultKind) -> None:
    before_mm = scale.read_mm()
    rig.inject(Fault(kind=kind, delay_s=0.2))
    assert scale.read_mm() == pytest.approx(before_mm, abs=0.02)
    assert scale.read_mm() == pytest.approx(before_mm, abs=0.02)


@pytest.mark.parametrize(
    ("kind", "error", "complaint"),
    [
        ("scale_silent", LinkLost, "does not answer"),
        ("scale_garbled", GarbledReply, "is not a reply it may give"),
        ("scale_fault_mark", DeviceFault, r"marks its value as faulty: FORMAT ERR\."),
    ],
)
def test_bad_scale_replies_end_in_their_error_and_pass(
    rig: EmulatedRig, scale: HeidenhainND, kind: FaultKind, error: type[DeviceError], complaint: str
) -> None:
    rig.inject(Fault(kind=kind, times=10_000))
    with pytest.raises(error, match=complaint):
        scale.read_mm()
    rig.clear_faults()
    assert scale.read_mm() == pytest.approx(111.65, abs=0.02)


def test_a_late_line_is_not_the_next_places_value(rig: EmulatedRig, axes: Axes, scale: HeidenhainND) -> None:
    """However late: the line of the first place must never be read at the second."""
    rig.inject(Fault(kind="scale_late", delay_s=1.2))
    with pytest.raises(DeviceError):
        scale.read_mm()
    go(axes, 12.0, 168.0)
    soon(lambda: can_read(scale))
    x, y = rig.machine.point_mm()
    assert scale.read_mm() == pytest.approx(((x - 1) ** 2 + (y + 129.5) ** 2) ** 0.5 - 437.25, abs=0.01)


def can_read(scale: HeidenhainND) -> bool:
    try:
        scale.read_mm()
    except DeviceError:
        return False
    return True


@pytest.mark.parametrize("kind", ["drive_silent", "drive_late", "servo_link_dropped"])
def test_one_lost_drive_reply_is_overcome(rig: EmulatedRig, axes: Axes, kind: FaultKind) -> None:
    rig.inject(Fault(kind=kind, joint=1, delay_s=0.4))
    assert axes[0].feedback_deg() == 0.0
    assert axes[1].feedback_deg() == 180.0


def test_a_dead_drive_is_a_lost_link_and_comes_back(rig: EmulatedRig, axes: Axes) -> None:
    rig.inject(Fault(kind="drive_silent", joint=2, times=10_000))
    with pytest.raises(LinkLost, match="Drive 2 does not answer"):
        axes[1].feedback_deg()
    assert axes[0].feedback_deg() == 0.0
    rig.clear_faults()
    assert axes[1].feedback_deg() == 180.0


def test_a_link_that_drops_for_long_comes_back(rig: EmulatedRig, axes: Axes) -> None:
    rig.inject(Fault(kind="servo_link_dropped", times=10_000))
    with pytest.raises(LinkLost):
        axes[0].feedback_deg()
    rig.clear_faults()
    assert axes[0].feedback_deg() == 0.0


def answer_of(bus: ModbusBus) -> list[int] | None:
    try:
        return bus.read(1, 0x602C, 2)
    except LinkLost:
        return None


def test_a_gateway_that_goes_quiet_for_long_comes_back(rig: EmulatedRig) -> None:
    """Its line is busy with requests whose askers have given up."""
    bus = ModbusBus(rig.servo_url, timeout_s=0.1, budget_s=0.5)
    bus.open("test")
    rig.inject(Fault(kind="drive_late", times=10_000, delay_s=0.25))
    with pytest.raises(LinkLost):
        bus.read(1, 0x602C, 2)
    rig.clear_faults()
    assert soon(lambda: answer_of(bus)) == [0, 0]
    bus.release("test")


def test_drive_exception_is_named(rig: EmulatedRig, axes: Axes) -> None:
    rig.inject(Fault(kind="drive_exception", joint=1, code=2))
    with pytest.raises(DeviceFault, match="exception 02"):
        axes[0].feedback_deg()


def test_drive_alarm_is_seen_and_reset(rig: EmulatedRig, axes: Axes) -> None:
    rig.inject(Fault(kind="drive_alarm", joint=1, code=0x150))
    axes[0].move_to(10.0, 20.0)
    assert axes[0].status().alarm == 0x150
    with pytest.raises(DeviceFault, match="alarm 150h"):
        axes[0].move_to(10.0, 20.0)
    axes[0].reset_alarm()
    axes[0].enable()
    go(axes, 10.0, 180.0)


def test_a_drive_that_never_is_in_position(rig: EmulatedRig, axes: Axes) -> None:
    rig.inject(Fault(kind="drive_never_in_position", joint=1))
    axes[0].move_to(10.0, 20.0)
    soon(lambda: not axes[0].status().moving)
    assert not axes[0].status().in_position


def test_a_move_whose_reply_is_lost_runs_once(rig: EmulatedRig) -> None:
    """The reply comes after the time-out; the drive has taken the move and the driver finds out."""
    bus = ModbusBus(rig.servo_url, timeout_s=0.3)
    axis = LeadshineEL7(bus, 1, JointScaling(10_000, 20, 0.0, 1), name="servo axis 1")
    axis.connect()
    axis.enable()
    sent: list[bytes] = []
    bus.line.recorder = lambda what, data: sent.append(data) if what == "tx" else None
    rig.inject(Fault(kind="drive_late", joint=1, after=2, delay_s=0.7))  # two reads precede the move
    axis.move_to(10.0, 20.0)
    soon(lambda: axis.status().in_position)
    assert [frame[7] for frame in sent].count(0x10) == 1
    axis.close()


def test_stops_faults_and_readers_at_once(rig: EmulatedRig, axes: Axes, scale: HeidenhainND) -> None:
    """Whatever happens on the wires, callers on several threads get values or a `DeviceError`."""
    script = (
        lambda: axes[0].move_to(10.0, 20.0),
        lambda: axes[0].move_to(-10.0, 20.0),
        lambda: axes[0].status(),
        lambda: axes[1].status(),
        lambda: scale.read_mm(),
        lambda: axes[0].quick_stop(),
        lambda: axes[0].reset_alarm(),
        lambda: rig.inject(Fault(kind="servo_link_dropped", after=3)),
        lambda: rig.inject(Fault(kind="drive_exception", after=5)),
        lambda: rig.inject(Fault(kind="drive_alarm", code=0x150)),
        lambda: rig.inject(Fault(kind="scale_garbled")),
    )
    surprises: list[Exception] = []

    def caller(seed: int) -> None:
        choice = Random(seed)
        for _ in range(60):
            try:
                choice.choice(script)()
            except DeviceError:
                continue
            except Exception as error:  # noqa: BLE001  the test is about these
                surprises.append(error)

    threads = [threading.Thread(target=caller, args=(seed,)) for seed in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not surprises
    rig.clear_faults()
    axes[0].reset_alarm()
    axes[0].enable()
    go(axes, 12.0, 168.0)
    x, y = rig.machine.point_mm()
    assert scale.read_mm() == pytest.approx(((x - 1) ** 2 + (y + 129.5) ** 2) ** 0.5 - 437.25, abs=0.01)


# -- as a program of its own -----------------------------------------------------------------------


def start(*arguments: str) -> tuple[subprocess.Popen[str], dict[str, dict[str, str]]]:
    process = subprocess.Popen(
        [sys.executable, "-m", "drivers.emulated", *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    addresses: dict[str, dict[str, str]] = json.loads(process.stdout.readline())
    return process, addresses


def end(process: subprocess.Popen[str]) -> int:
    process.communicate(timeout=PATIENCE_S)
    return process.returncode


def test_program_serves_until_its_input_ends() -> None:
    process, addresses = start(str(DEFAULT_RIG), "--speed", "500")
    scale = HeidenhainND(addresses["scale"]["url"])
    scale.connect()
    assert scale.read_mm() == pytest.approx(111.65, abs=0.02)
    scale.close()
    assert end(process) == 0


def test_program_ends_when_terminated() -> None:
    process, _ = start()
    process.send_signal(signal.SIGTERM)
    assert end(process) == 0


def test_program_killed_finds_its_drives_where_they_were(tmp_path: Path) -> None:
    state_file = tmp_path / "place.json"
    process, addresses = start("--speed", "500", "--state", str(state_file))
    bus = ModbusBus(addresses["servo"]["url"])
    axis = LeadshineEL7(bus, 1, JointScaling(10_000, 20, 0.0, 1), name="servo axis 1")
    axis.connect()
    axis.enable()
    axis.move_to(9.0, 20.0)
    soon(lambda: axis.status().in_position)
    left_deg = axis.feedback_deg()
    axis.close()
    soon(lambda: saved_deg(state_file) == pytest.approx(left_deg, abs=1e-3))
    os.kill(process.pid, signal.SIGKILL)
    end(process)
    process, addresses = start("--state", str(state_file))
    bus = ModbusBus(addresses["servo"]["url"])
    axis = LeadshineEL7(bus, 1, JointScaling(10_000, 20, 0.0, 1), name="servo axis 1")
    axis.connect()
    assert axis.feedback_deg() == left_deg
    axis.close()
    assert end(process) == 0


def saved_deg(state_file: Path) -> float:
    if not state_file.exists():
        return float("nan")
    return float(json.loads(state_file.read_text())["shaft_pulses"][0]) / MachineSpec().pulses_per_deg


def test_program_refuses_bad_input(tmp_path: Path) -> None:
    rig_file = tmp_path / "rig.toml"
    rig_file.write_text("[machine]\nratio = -1\n")
    process = subprocess.run(
        [sys.executable, "-m", "drivers.emulated", str(rig_file)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert process.returncode == 2
    assert process.stderr.count("\n") == 1 and "[machine] ratio" in process.stderr
