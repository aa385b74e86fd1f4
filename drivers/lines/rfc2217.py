"""A serial port of a device server that also accepts the line settings (RFC 2217), with pyserial."""

from __future__ import annotations

import errno
import time
from contextlib import suppress

from serial import SerialException
from serial.rfc2217 import Serial

from drivers.errors import LinkLost
from drivers.lines.url import RemoteSerialAddress

_LOOK_S = 0.001


class RemotePort:
    """As `drivers.lines.ports.Port`."""

    def __init__(self, port: Serial) -> None:
        self._port = port

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def read_some(self, deadline_s: float) -> bytes:
        # The library receives in its own thread; only its queue can be waited on.
        while not (waiting := self._port.in_waiting):
            if time.monotonic() >= deadline_s:
                return b""
            time.sleep(_LOOK_S)
        data = bytes(self._port.read(waiting))
        if not data:  # the end mark
            raise ConnectionResetError(errno.ECONNRESET, "the far end closed the connection")
        return data

    def interrupt(self) -> None:
        """Deadlines on a serial line are short; interrupting them has no benefit."""

    def close(self) -> None:
        with suppress(OSError):
            self._port.close()


def open_remote_port(address: RemoteSerialAddress, *, xonxoff: bool) -> RemotePort:
    """:raises LinkLost: there is no answer, or one that violates RFC 2217"""
    try:
        port = Serial(
            # ser2net accepts flow control, and does not report it
            f"rfc2217://{address.host}:{address.port}?ign_set_control",
            baudrate=address.baud,
            bytesize=address.format.data_bits,
            parity=address.format.parity,
            stopbits=address.format.stop_bits,
            xonxoff=xonxoff,
            timeout=0,
        )
    except (SerialException, OSError, ValueError) as error:
        raise LinkLost(
            f"{address} cannot be opened: {str(error).rstrip('.')}; is it a device server with RFC 2217?"
        ) from error
    return RemotePort(port)
