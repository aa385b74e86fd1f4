"""The Modbus line against a server that no one here wrote (pymodbus), over TCP."""

from __future__ import annotations

import asyncio
import logging
import threading
from collections.abc import Iterator
from typing import Any

import pytest
from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

from drivers.errors import DeviceFault
from drivers.lines import ModbusBus

logging.getLogger("pymodbus.logging").setLevel(logging.CRITICAL)


@pytest.fixture
def url() -> Iterator[str]:
    """Two drives with eight registers from 6200h, ended with the test."""
    loop = asyncio.new_event_loop()
    drives = [
        SimDevice(unit, simdata=[SimData(0x6200, count=8, values=0, datatype=DataType.REGISTERS)])
        for unit in (1, 2)
    ]

    async def started() -> tuple[ModbusTcpServer, int]:
        server = ModbusTcpServer(drives, address=("127.0.0.1", 0))
        await server.serve_forever(background=True)
        listening: Any = server.transport
        return server, int(listening.sockets[0].getsockname()[1])

    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    server, port = asyncio.run_coroutine_threadsafe(started(), loop).result(5)
    yield f"modbus+tcp://127.0.0.1:{port}"
    ended = server.shutdown()  # type: ignore[no-untyped-call]
    asyncio.run_coroutine_threadsafe(ended, loop).result(5)
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()


def test_writes_reads_and_refusals(url: str) -> None:
    bus = ModbusBus(url)
    bus.open("test")
    bus.write(1, 0x6200, [1, 0xFFFF, 0x8000, 33, 100, 100, 0, 0x10], stops_seen=bus.stops)
    bus.write_one(2, 0x6203, 44)
    assert bus.read(1, 0x6200, 8) == [1, 0xFFFF, 0x8000, 33, 100, 100, 0, 0x10]
    assert bus.read(2, 0x6203, 1) == [44]
    bus.stop(2, 0x6203, 0, look_at=0x6203)
    assert bus.read(2, 0x6203, 1) == [0]
    with pytest.raises(DeviceFault, match="exception 02"):
        bus.read(1, 0x1000, 1)
    bus.release("test")
