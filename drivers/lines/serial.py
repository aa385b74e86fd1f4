"""One serial line: opened from a URL, written to, and read into a parser of one's own with a deadline."""

from __future__ import annotations

import errno
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Literal

import serial

from drivers.errors import DeviceError, LinkLost
from drivers.lines.url import LineFormat, SerialAddress, parse_line_url

if sys.platform == "win32":
    _FORMAT_REFUSED = serial.SerialException
else:
    import termios

    _FORMAT_REFUSED = termios.error

Trace = Callable[[Literal["tx", "rx"], bytes], None]
"""A flight recorder's hook: what crossed the wire, and which way."""

# Waiting happens in slices: changing a port's time-out re-applies all its settings, which a
# pseudo-terminal refuses, so the time-out is set once and deadlines are kept here.
_SLICE_S = 0.02


class SerialLine:
    """An open line.  XON/XOFF is honoured by the operating system on serial ports."""

    def __init__(self, url: str, *, default_baud: int = 9600, default_format: str = "8N1") -> None:
        """Read the URL; nothing is opened yet.

        :raises BadUrl: one sentence about what is wrong in it
        """
        self.address = parse_line_url(
            url, serial="serial", net="socket", default_baud=default_baud, default_format=default_format
        )
        self.trace: Trace | None = None
        self._port: serial.Serial | None = None

    @property
    def notice(self) -> str | None:
        """One sentence to log at start when the line format is overridden, else None."""
        return self.address.notice if isinstance(self.address, SerialAddress) else None

    def open(self) -> None:
        """Open for this process alone.

        :raises LinkLost: the port is missing, busy or unreachable
        :raises DeviceError: the port cannot carry the line format
        """
        self.close()
        if isinstance(self.address, SerialAddress):
            self._port = open_serial_port(self.address, xonxoff=True)
            return
        try:
            self._port = serial.serial_for_url(f"socket://{self.address}", timeout=_SLICE_S)
        except OSError as error:
            raise LinkLost(f"{self.address} cannot be reached: {_reason(error)}.") from error

    def close(self) -> None:
        """Release the port; never raises."""
        if self._port is not None:
            port, self._port = self._port, None
            with suppress(OSError):  # the cable may be out
                port.close()

    def write(self, data: bytes) -> None:
        """:raises LinkLost: the line is not open or broke"""
        port = self._opened()
        try:
            port.write(data)
        except OSError as error:
            self.close()
            raise LinkLost(f"{self.address} broke while writing: {_reason(error)}.") from error
        if self.trace is not None:
            self.trace("tx", data)

    def read_some(self, deadline_s: float) -> bytes:
        """Whatever has come in, at least one byte; empty once `time.monotonic()` passes the deadline.

        :raises LinkLost: the line is not open or broke
        """
        port = self._opened()
        while True:
            expired = time.monotonic() >= deadline_s
            try:
                # read() waits for a slice of time when nothing is there
                data = b"" if expired and not port.in_waiting else bytes(port.read(max(1, port.in_waiting)))
            except OSError as error:
                self.close()
                raise LinkLost(f"{self.address} broke while reading: {_reason(error)}.") from error
            if data:
                if self.trace is not None:
                    self.trace("rx", data)
                return data
            if expired:
                return b""

    def drain(self, seconds: float) -> None:
        """Throw away everything that arrives within the next `seconds` (0: what is there already).

        :raises LinkLost: the line is not open or broke
        """
        deadline_s = time.monotonic() + seconds
        while self.read_some(deadline_s):
            pass

    def _opened(self) -> serial.Serial:
        if self._port is None:
            raise LinkLost(f"{self.address} is not open; connect again.")
        return self._port


def open_serial_port(address: SerialAddress, *, xonxoff: bool) -> serial.Serial:
    """Open a port for this process alone, and make sure that it took the line format.

    :raises LinkLost: the port is missing or busy
    :raises DeviceError: the port cannot carry the line format
    """
    wanted = address.effective_format
    try:
        port = serial.Serial(
            address.port,
            baudrate=address.baud,
            bytesize=wanted.data_bits,
            parity=wanted.parity,
            stopbits=wanted.stop_bits,
            xonxoff=xonxoff,
            timeout=_SLICE_S,
            write_timeout=1.0,
            exclusive=True,
        )
    except (OSError, ValueError) as error:
        raise LinkLost(f"{address} cannot be opened: {_reason(error)}.") from error
    except _FORMAT_REFUSED as error:
        raise _cannot_carry(address) from error
    if not _carries(port, wanted):
        port.close()
        raise _cannot_carry(address)
    return port


def _cannot_carry(address: SerialAddress) -> DeviceError:
    return DeviceError(
        f"{address} cannot carry {address.effective_format}"
        " (a pseudo-terminal has neither parity nor 7 bits);"
        " add override=8N1 to its URL if that is intended."
    )


def _carries(port: serial.SerialBase, wanted: LineFormat) -> bool:
    """Whether the port took data bits and parity.

    A pseudo-terminal drops both without a word the first time, and refuses the second time.
    """
    if sys.platform == "win32":
        return True  # the port's driver refuses by itself there
    control_flags = termios.tcgetattr(port.fileno())[2]
    data_bits = {termios.CS7: 7, termios.CS8: 8}.get(control_flags & termios.CSIZE)
    return data_bits == wanted.data_bits and bool(control_flags & termios.PARENB) == (wanted.parity != "N")


def _reason(error: Exception) -> str:
    code = error.errno if isinstance(error, OSError) else None
    if code == errno.ENOENT:
        return "there is no such port (is the adapter plugged in?)"
    if code == errno.EACCES:
        return "permission denied (is the user in the group of serial ports?)"
    if code in (errno.EAGAIN, errno.EBUSY):
        return "another program holds it"
    return str(error).rstrip(".")
