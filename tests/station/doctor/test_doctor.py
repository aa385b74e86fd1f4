"""`station doctor` on lines with something wrong with them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tty
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import DEFAULT_RIG, load_rig
from drivers.lines import SerialLine
from station.cli import main
from station.doctor.finding import Finding
from station.doctor.ports import examine_port, holders_of
from station.doctor.swapped import axes_exchanged
from station.five_bar import Robot, inverse
from station.motion import outside_mm
from station.service import holding
from station.settings import Settings
from tests.drivers.wire import echoing_port


def doctor(home: Path, *arguments: str) -> Result:
    return CliRunner().invoke(main, ["--home", str(home), "doctor", *arguments])


def station_file(folder: Path, scale_url: str, servo_url: str, *, first_unit: int = 1) -> str:
    path = folder / "station.toml"
    path.write_text(
        f'[scale]\nprotocol = "heidenhain-nd"\nurl = {json.dumps(scale_url)}\ntimeout_s = 0.1\n'
        f'[servo]\nprofile = "leadshine-el7"\nurl = {json.dumps(servo_url)}\ntimeout_s = 0.1\n'
        f"[[servo.joint]]\nunit = {first_unit}\nzero_at_deg = 0\n"
        f"[[servo.joint]]\nunit = {3 - first_unit}\nzero_at_deg = 180\n"
    )
    return str(path)


@pytest.fixture
def rig() -> Iterator[EmulatedRig]:
    with EmulatedRig(load_rig(DEFAULT_RIG), speed=500) as running:
        yield running


def test_an_emulated_station_is_healthy_and_nothing_moves(tmp_path: Path) -> None:
    result = doctor(tmp_path)
    assert result.exit_code == 0, result.output
    for said in ("itself as ND281B", "stands at 0.0000 deg", "stands at 180.0000 deg", "ms as a rule"):
        assert said in result.output
    state = json.loads((tmp_path / "emulated-rig.json").read_text())
    assert state == {"shaft_pulses": [0.0, 0.0], "zero_pulses": [0, 0]}


def test_a_port_that_is_not_there(tmp_path: Path, rig: EmulatedRig) -> None:
    result = doctor(tmp_path, "--config", station_file(tmp_path, "serial:///dev/ttyNO", rig.servo_url))
    assert result.exit_code == 1
    assert "there is no such port" in result.output
    assert "adapters there are" in result.output
    assert "stands at 180.0000 deg" in result.output  # the others are looked at all the same


def test_an_adapter_that_echoes(tmp_path: Path, rig: EmulatedRig) -> None:
    with echoing_port() as port:
        url = f"serial://{port}?override=8N1"
        result = doctor(tmp_path, "--config", station_file(tmp_path, url, rig.servo_url))
    assert result.exit_code == 1
    assert "add echo=1 to its address" in " ".join(result.output.replace("│", " ").split())


def test_another_program_that_holds_the_port(tmp_path: Path) -> None:
    with ExitStack() as stack:
        ends = os.openpty()
        for end in ends:
            stack.callback(os.close, end)
        tty.setraw(ends[1])
        port = os.ttyname(ends[1])
        waiting = "import sys; held = open(sys.argv[1]); print(flush=True); sys.stdin.read()"
        holder = stack.enter_context(
            subprocess.Popen(
                [sys.executable, "-c", waiting, port], stdin=subprocess.PIPE, stdout=subprocess.PIPE
            )
        )
        assert holder.stdout is not None
        holder.stdout.readline()
        assert [name for name in holders_of(Path(port)) if f"(process {holder.pid})" in name]
        finding = Finding("line")
        examine_port(SerialLine(f"serial://{port}"), finding)
        assert holder.stdin is not None
        holder.stdin.close()
    assert f"(process {holder.pid}) too" in finding.parts[0].text
    assert not finding.healthy


def test_a_port_is_named_by_its_adapter(tmp_path: Path) -> None:
    device, station = os.openpty()
    try:
        tty.setraw(station)
        port = os.ttyname(station)
        (tmp_path / "usb-FTDI_A1-if00-port0").symlink_to(port)
        finding, named = Finding("line"), Finding("line")
        assert examine_port(SerialLine(f"serial://{port}"), finding, by_id=tmp_path)
        url = f"serial://{tmp_path}/usb-FTDI_A1-if00-port0"
        assert examine_port(SerialLine(url), named, by_id=tmp_path)
    finally:
        os.close(device)
        os.close(station)
    assert f"name it {tmp_path}/usb-FTDI_A1-if00-port0" in finding.parts[0].do
    assert named.parts[0].text == f"names its adapter; it is {port} at present"
    assert finding.healthy


def test_drives_that_are_exchanged() -> None:
    """Where the arm stands makes no sense with them, and does without."""
    joints = Settings().joints
    robot = Robot.default()
    first, second = np.degrees(inverse(robot.geometry, np.array([200.0 - 770.0j])))[0]
    pulses = joints[0].scaling.to_pulses(first), joints[1].scaling.to_pulses(second)
    seen = joints[0].scaling.to_deg(pulses[1]), joints[1].scaling.to_deg(pulses[0])
    assert outside_mm(robot, seen) > 0.0
    assert axes_exchanged(Settings(), robot, seen)
    assert not axes_exchanged(Settings(), robot, (first, second))


def test_a_station_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    result = doctor(tmp_path, "--config", str(tmp_path / "none.toml"))
    assert result.exit_code == 2
    assert result.output.count("\n") == 1


def test_a_rig_that_another_station_holds_is_left_alone(tmp_path: Path) -> None:
    with holding(tmp_path):
        result = doctor(tmp_path)
    assert result.exit_code == 2
    assert "Another station process holds the rig" in result.output
