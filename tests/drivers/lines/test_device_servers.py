"""Lines through device servers that no one here wrote: ser2net (RFC 2217), socat; and mbpoll as a master."""

from __future__ import annotations

import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import parse_rig
from drivers.errors import LinkLost
from drivers.lines import ModbusBus, SerialLine
from drivers.scales import SCALES

PATIENCE_S = 5.0


def needs(program: str) -> pytest.MarkDecorator:
    found = shutil.which(program, path="/usr/sbin:/usr/bin:/bin:/usr/local/bin")
    return pytest.mark.skipif(found is None, reason=f"{program} is not installed (apt-get install {program})")


@contextmanager
def serving(*command: str, port: int) -> Iterator[None]:
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline_s = time.monotonic() + PATIENCE_S
        while not _listens(port):
            assert process.poll() is None and time.monotonic() < deadline_s, f"{command[0]} does not listen"
            time.sleep(0.02)
        yield
    finally:
        process.terminate()
        process.wait()


def _listens(port: int) -> bool:
    """Without a connection: a device server has one at a time."""
    wanted = f"0100007F:{port:04X}"
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return any(row[1] == wanted and row[3] == "0A" for row in rows)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.fixture
def rtu_rig() -> Iterator[EmulatedRig]:
    text = '[emulated]\nline = "rtu"\nscale = "siko"\nbaud = 115200\n'
    with EmulatedRig(parse_rig(text), speed=200) as rig:
        yield rig


def device(url: str) -> str:
    return url.partition("://")[2].partition("?")[0]


@needs("ser2net")
@pytest.mark.filterwarnings("ignore:set(Daemon|Name).. is deprecated")  # pyserial's
def test_a_scale_and_drives_through_ser2net_with_line_settings(rtu_rig: EmulatedRig, tmp_path: Path) -> None:
    scale_port, servo_port = free_port(), free_port()
    config = tmp_path / "ser2net.yaml"
    config.write_text(
        "".join(
            f"connection: &line{port}\n"
            f"  accepter: telnet(rfc2217),tcp,127.0.0.1,{port}\n"
            f"  connector: serialdev,{device(url)},{speed}n81,local\n"
            for port, url, speed in (
                (scale_port, rtu_rig.scale_url, 19200),
                (servo_port, rtu_rig.servo_url, 115200),
            )
        )
    )
    with serving("/usr/sbin/ser2net", "-n", "-c", str(config), port=servo_port):
        driver = SCALES["siko"]
        scale = driver.make(driver.settings(url=f"rfc2217://127.0.0.1:{scale_port}?baud=19200&format=8N1"))
        scale.connect()
        assert scale.read_mm() == pytest.approx(rtu_rig.machine.head_mm(), abs=0.02)
        scale.close()
        bus = ModbusBus(f"modbus+rfc2217://127.0.0.1:{servo_port}?baud=115200&format=8N1")
        bus.open("test")
        assert bus.read(1, 0x0003, 1) == [6]
        bus.release("test")


@needs("socat")
def test_rtu_frames_through_a_plain_device_server(rtu_rig: EmulatedRig) -> None:
    port = free_port()
    to = f"{device(rtu_rig.servo_url)},rawer"
    with serving("/usr/bin/socat", f"TCP-LISTEN:{port},bind=127.0.0.1,reuseaddr", to, port=port):
        bus = ModbusBus(f"modbus+rtuovertcp://127.0.0.1:{port}")
        bus.open("test")
        assert bus.read(2, 0x0003, 1) == [6]
        bus.release("test")


@needs("mbpoll")
@pytest.mark.parametrize("line", ["tcp", "rtu"])
def test_the_emulated_drives_answer_another_master(line: str) -> None:
    with EmulatedRig(parse_rig(f'[emulated]\nline = "{line}"\nbaud = 38400\n')) as rig:
        where = ["-m", "rtu", "-b", "38400", "-P", "none", "-s", "2", device(rig.servo_url)]
        if line == "tcp":
            host, _, port = rig.servo_url.removeprefix("modbus+tcp://").partition(":")
            where = ["-m", "tcp", "-p", port, host]
        done = subprocess.run(
            ["/usr/bin/mbpoll", "-a", "1", "-t", "4", "-0", "-r", "3", "-c", "1", "-1", *where],
            capture_output=True,
            text=True,
            timeout=10,
        )
    assert "[3]: \t6" in done.stdout, done.stdout + done.stderr


@pytest.mark.filterwarnings("ignore:set(Daemon|Name).. is deprecated")
def test_nobody_at_the_far_end() -> None:
    line = SerialLine(f"rfc2217://127.0.0.1:{free_port()}?baud=9600")
    with pytest.raises(LinkLost, match="cannot be opened"):
        line.open()
