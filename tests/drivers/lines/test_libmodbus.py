"""libmodbus as a master of the emulated drives, and as the slave of the station's own master."""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest

from drivers.emulated.rig import EmulatedRig
from drivers.emulated.rig_file import parse_rig
from drivers.errors import DeviceFault
from drivers.lines import ModbusBus
from tests.drivers.lines.libmodbus import LIBRARY, Refused, device, master, rtu_slave, tcp_slave

pytestmark = pytest.mark.skipif(
    LIBRARY is None, reason="libmodbus is not installed (deploy/debian-packages mbpoll)"
)
MOVE = [0x0001, 0x0000, 0x2710, 600, 100, 100, 0, 0x0010]
PATIENCE_S = 5.0


@pytest.fixture(params=["tcp", "rtu"])
def rig(request: pytest.FixtureRequest) -> Iterator[EmulatedRig]:
    text = f'[machine]\nscatter = false\n[emulated]\nline = "{request.param}"\nbaud = 38400\n'
    with EmulatedRig(parse_rig(text), speed=500) as rig:
        yield rig


def test_it_moves_an_emulated_drive(rig: EmulatedRig) -> None:
    with master(device(rig.servo_url), 1) as drive:
        assert drive.read(0x0003, 1) == [6]
        drive.write_one(0x0401, 0x0083)
        drive.write(0x6200, MOVE)
        deadline_s = time.monotonic() + PATIENCE_S
        while drive.read(0x0B05, 1)[0] & 4 and time.monotonic() < deadline_s:
            pass
        assert drive.read(0x602C, 2) == [0, 0x2710]


def test_it_is_refused_what_there_is_not(rig: EmulatedRig) -> None:
    with master(device(rig.servo_url), 2) as drive:
        with pytest.raises(Refused, match="Illegal data address"):
            drive.read(0x7000, 1)
        with pytest.raises(Refused, match="Illegal data value"):
            drive.write(0x6200, MOVE)  # not switched on


def test_it_reads_the_door_and_the_thermometer(rig: EmulatedRig) -> None:
    with master(device(rig.servo_url), 3) as module:
        assert module.read(0, 2) == [1, 200]


def exchanges(bus: ModbusBus) -> None:
    """Every kind that drivers use, with a stop past an open connection."""
    bus.open("test")
    try:
        bus.write_one(1, 5, 0xBEEF)
        bus.write(1, 10, list(range(100, 120)), stops_seen=bus.stops)
        assert bus.read(1, 5, 1) == [0xBEEF]
        assert bus.read(1, 10, 20) == list(range(100, 120))
        with pytest.raises(DeviceFault, match="no such register"):
            bus.read(1, 250, 20)
        bus.stop(1, 7, 0x0040, look_at=8)
        assert bus.read(1, 7, 1) == [0x0040]
        bus.stop(1, 20, [0, 0x11], look_at=8)
        assert bus.read(1, 20, 2) == [0, 0x11]
    finally:
        bus.release("test")


def test_its_tcp_slave_is_driven() -> None:
    with tcp_slave(256) as (slave, port):
        exchanges(ModbusBus(f"modbus+tcp://127.0.0.1:{port}", timeout_s=0.5))
        assert [slave[address] for address in (5, 10, 29, 21)] == [0xBEEF, 100, 119, 0x11]


def test_its_rtu_slave_is_driven() -> None:
    with rtu_slave(1, 256) as (slave, port):
        exchanges(ModbusBus(f"modbus+rtu://{port}?baud=38400&format=8N2", timeout_s=0.5))
        assert [slave[address] for address in (5, 10, 29, 21)] == [0xBEEF, 100, 119, 0x11]
