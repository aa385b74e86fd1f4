"""A device on a pseudo-terminal."""

from __future__ import annotations

import os
import select
import time
import tty
from collections.abc import Callable
from threading import Thread

from drivers.emulated.readout import Reply

_XON, _XOFF = 0x11, 0x13


class PtyLine:
    """Serves one device from its own thread until closed.

    :param receive: bytes from the station in, replies out
    :param flow_control: whether the device uses XON/XOFF; otherwise these are ordinary bytes
    """

    def __init__(self, receive: Callable[[bytes], list[Reply]], flow_control: bool = True) -> None:
        self._receive = receive
        self._flow_control = flow_control
        self._device, self._station = os.openpty()
        # kept open here, so that the line survives the station closing and opening it
        tty.setraw(self._station)
        self.port = os.ttyname(self._station)
        self._wake_read, self._wake_write = os.pipe()
        self._paused = False
        self._thread = Thread(target=self._serve, name=f"emulated device on {self.port}")
        self._thread.start()

    def close(self) -> None:
        """Stop the thread and free the pseudo-terminal."""
        os.write(self._wake_write, b"x")
        self._thread.join()
        for descriptor in (self._device, self._station, self._wake_read, self._wake_write):
            os.close(descriptor)

    def _serve(self) -> None:
        pending: list[tuple[float, bytes]] = []
        while True:
            wait_s = None
            if pending and not self._paused:
                wait_s = max(0.0, pending[0][0] - time.monotonic())
            readable, _, _ = select.select([self._device, self._wake_read], [], [], wait_s)
            if self._wake_read in readable:
                return
            if self._device in readable:
                for reply in self._receive(self._without_flow_control(os.read(self._device, 256))):
                    # replies retain their order: a late one delays all after it
                    due_s = max(time.monotonic() + reply.delay_s, pending[-1][0] if pending else 0.0)
                    pending.append((due_s, reply.data))
            while pending and not self._paused and pending[0][0] <= time.monotonic():
                os.write(self._device, pending.pop(0)[1])

    def _without_flow_control(self, data: bytes) -> bytes:
        if not self._flow_control:
            return data
        for byte in data:
            if byte in (_XON, _XOFF):
                self._paused = byte == _XOFF
        return data.translate(None, bytes((_XON, _XOFF)))
