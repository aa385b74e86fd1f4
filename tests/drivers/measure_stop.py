"""Measures how long a stop takes to the drive that answers, while the other one is silent.

`python -m tests.drivers.measure_stop [TIMES]`: time from the call to the arrival of the stop frame at the
device, on RS-485 at 38400 (a pseudo-terminal that keeps the time of each byte) and over a TCP gateway that
serves each connection in order.  The driver is querying the silent drive when the stop is requested.
"""

from __future__ import annotations

import os
import random
import select
import socket
import statistics
import sys
import threading
import time
import tty
from collections.abc import Callable
from contextlib import suppress

from drivers.driver import Drive
from drivers.errors import DeviceError
from drivers.scaling import JointScaling
from drivers.servos.leadshine_el7 import DRIVER, LeadshineSettings
from tests.drivers.wire import rtu

_BYTE_S = 11 / 38400
_STOP = bytes.fromhex("06 6002 0040")


class _Seen:
    """When the stop of drive 2 arrived."""

    def __init__(self) -> None:
        self.at_s: float | None = None
        self.arrived = threading.Event()

    def frame(self, unit: int, pdu: bytes) -> bytes | None:
        """The reply PDU of drive 2; drive 1 is silent."""
        if unit != 2:
            return None
        if pdu.startswith(_STOP) and not self.arrived.is_set():
            self.at_s = time.monotonic()
            self.arrived.set()
        return pdu if pdu[0] == 6 else bytes((3, 2 * pdu[4])) + bytes(2 * pdu[4])


def _serve_rtu(device: int, seen: list[_Seen], ended: threading.Event) -> None:
    received = b""
    while not ended.is_set():
        if not select.select([device], [], [], 0.01)[0]:
            continue
        received += os.read(device, 256)
        while len(received) >= 8:  # all requests here have eight bytes
            frame, received = received[:8], received[8:]
            time.sleep(8 * _BYTE_S)
            pdu = seen[-1].frame(frame[0], frame[1:-2])
            if pdu is not None:
                reply = rtu(frame[:1].hex() + pdu.hex())
                time.sleep(len(reply) * _BYTE_S + 0.002)
                os.write(device, reply)


def _serve_tcp(listener: socket.socket, seen: list[_Seen], ended: threading.Event) -> None:
    def serve(connection: socket.socket) -> None:
        with connection:
            while not ended.is_set():
                try:
                    frame = connection.recv(12)
                except OSError:
                    return
                if not frame:
                    return
                pdu = seen[-1].frame(frame[6], frame[7:])
                if pdu is None:
                    ended.wait(1.0)  # the gateway's own time-out
                else:
                    reply = frame[:4] + (len(pdu) + 1).to_bytes(2, "big") + frame[6:7] + pdu
                    connection.sendall(reply)

    while not ended.is_set():
        try:
            connection, _ = listener.accept()
        except TimeoutError:
            continue
        threading.Thread(target=serve, args=(connection,), daemon=True).start()


def _measure(name: str, url: str, seen: list[_Seen], times: int) -> None:
    scaling = JointScaling(10_000, 20, 0.0, 1)
    axes = DRIVER.make(LeadshineSettings(url=url), [Drive(f"axis {n}", n, scaling) for n in (1, 2)])
    delays_s = []
    for _ in range(times):
        seen.append(_Seen())
        calls: list[Callable[[], object]] = [axes[0].status, axes[0].quick_stop, axes[1].quick_stop]
        threads = [threading.Thread(target=_quietly, args=(call,)) for call in calls]
        threads[0].start()
        time.sleep(random.uniform(0.0, 0.05))
        began_s = time.monotonic()
        for thread in threads[1:]:
            thread.start()
        if seen[-1].arrived.wait(5.0):
            delays_s.append((seen[-1].at_s or 0.0) - began_s)
        for thread in threads:
            thread.join()
    delays_ms = sorted(1000 * delay_s for delay_s in delays_s)
    p99 = delays_ms[min(len(delays_ms) - 1, int(0.99 * len(delays_ms)))]
    print(
        f"{name}: {len(delays_ms)} of {times} arrived; median {statistics.median(delays_ms):.1f} ms,"
        f" 99th percentile {p99:.1f} ms, longest {delays_ms[-1]:.1f} ms"
    )


def _quietly(call: Callable[[], object]) -> None:
    with suppress(DeviceError):
        call()


def main(times: int) -> None:
    """Print one line for each kind of line."""
    ended, seen = threading.Event(), [_Seen()]
    device, station = os.openpty()
    tty.setraw(station)
    listener = socket.create_server(("127.0.0.1", 0))
    listener.settimeout(0.05)
    threading.Thread(target=_serve_rtu, args=(device, seen, ended), daemon=True).start()
    threading.Thread(target=_serve_tcp, args=(listener, seen, ended), daemon=True).start()
    _measure("TCP", f"modbus+tcp://127.0.0.1:{listener.getsockname()[1]}", seen, times)
    _measure("RTU at 38400", f"modbus+rtu://{os.ttyname(station)}?baud=38400&format=8N2", seen, times)
    ended.set()


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 500)
