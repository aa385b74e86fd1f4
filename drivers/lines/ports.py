"""Transports for bytes: a serial port or a network connection, opened for this process exclusively."""

from __future__ import annotations

import errno
import fcntl
import select
import socket
import termios
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Protocol

import serial

from drivers.errors import DeviceError, LinkLost
from drivers.lines.rfc2217 import open_remote_port
from drivers.lines.url import LineFormat, NetAddress, RemoteSerialAddress, SerialAddress

CONNECT_LIMIT_S = 1.0
_IFLAG, _CFLAG = 0, 2  # indices in the result of termios.tcgetattr


class Port(Protocol):
    """An open port. Every failure is an `OSError`, including a closed connection at the far end."""

    def write(self, data: bytes) -> None: ...

    def read_some(self, deadline_s: float) -> bytes:
        """At least one byte, or none once `time.monotonic()` passes the deadline."""
        ...

    def interrupt(self) -> None:
        """Make a reader in another thread stop waiting, if the port supports that."""
        ...

    def close(self) -> None:
        """Never raises."""
        ...


Opener = Callable[[SerialAddress | NetAddress, bool], Port]
"""Function with the signature of `open_port`."""


def open_port(address: SerialAddress | NetAddress, xonxoff: bool) -> Port:
    """Open it for this process exclusively.

    :raises LinkLost: the port is missing, busy or unreachable
    :raises DeviceError: the port cannot carry the line format
    """
    if isinstance(address, SerialAddress):
        return _SerialPort(open_serial_port(address, xonxoff=xonxoff))
    if isinstance(address, RemoteSerialAddress):
        return open_remote_port(address, xonxoff=xonxoff)
    try:
        return _SocketPort(socket.create_connection((address.host, address.port), CONNECT_LIMIT_S))
    except OSError as error:
        raise LinkLost(
            f"{address} cannot be reached: {reason(error)}; check cable, power and address."
        ) from error


class _SerialPort:
    def __init__(self, port: serial.Serial) -> None:
        self._port = port

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def read_some(self, deadline_s: float) -> bytes:
        # Waiting is done here: changing the port's own time-out re-applies all its settings, which a
        # pseudo-terminal refuses.
        readable, _, _ = select.select([self._port], [], [], max(0.0, deadline_s - time.monotonic()))
        return bytes(self._port.read(max(1, self._port.in_waiting))) if readable else b""

    def interrupt(self) -> None:
        """Deadlines on a serial line are short; interrupting them has no benefit."""

    def close(self) -> None:
        with suppress(OSError):  # the cable may be disconnected
            # a pseudo-terminal whose other side stays open would remember it
            fcntl.ioctl(self._port.fileno(), termios.TIOCNXCL)
        with suppress(OSError):
            self._port.close()


class _SocketPort:
    def __init__(self, connection: socket.socket) -> None:
        self._connection = connection
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.settimeout(CONNECT_LIMIT_S)  # for sending; reading waits for its deadline

    def write(self, data: bytes) -> None:
        self._connection.sendall(data)

    def read_some(self, deadline_s: float) -> bytes:
        readable, _, _ = select.select([self._connection], [], [], max(0.0, deadline_s - time.monotonic()))
        if not readable:
            return b""
        data = self._connection.recv(4096)
        if not data:
            raise ConnectionResetError(errno.ECONNRESET, "the far end closed the connection")
        return data

    def interrupt(self) -> None:
        with suppress(OSError):  # closed already
            self._connection.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        self._connection.close()


def open_serial_port(address: SerialAddress, *, xonxoff: bool) -> serial.Serial:
    """Open a port for this process exclusively, and verify that it accepted the line format.

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
            timeout=0,
            write_timeout=1.0,
            exclusive=True,
        )
    except (OSError, ValueError) as error:
        raise LinkLost(f"{address} cannot be opened: {reason(error)}.") from error
    except termios.error as error:
        raise _cannot_carry(address) from error
    if not _carries(port, wanted):
        port.close()
        raise _cannot_carry(address)
    # The lock of `exclusive` is advisory: only programs that request it respect it.
    fcntl.ioctl(port.fileno(), termios.TIOCEXCL)
    if wanted.parity != "N":
        _check_parity(port)
    return port


def _check_parity(port: serial.Serial) -> None:
    """Let the line mark a byte of wrong parity (as NUL, which no reply may hold): pyserial turns that off."""
    attributes = termios.tcgetattr(port.fileno())
    attributes[_IFLAG] = with_parity_check(attributes[_IFLAG])
    termios.tcsetattr(port.fileno(), termios.TCSANOW, attributes)


def with_parity_check(input_flags: int) -> int:
    """Input flags under which a byte of wrong parity arrives as NUL."""
    return (input_flags | termios.INPCK) & ~(termios.IGNPAR | termios.PARMRK)


def _cannot_carry(address: SerialAddress) -> DeviceError:
    return DeviceError(
        f"{address} cannot carry {address.effective_format}"
        " (a pseudo-terminal has neither parity nor 7 bits);"
        " add override=8N1 to its URL if that is intended."
    )


def _carries(port: serial.Serial, wanted: LineFormat) -> bool:
    """Whether the port accepted data bits and parity.

    A pseudo-terminal silently ignores both the first time, and refuses the second time.
    """
    control_flags = termios.tcgetattr(port.fileno())[_CFLAG]
    data_bits = {termios.CS7: 7, termios.CS8: 8}.get(control_flags & termios.CSIZE)
    return data_bits == wanted.data_bits and bool(control_flags & termios.PARENB) == (wanted.parity != "N")


def reason(error: Exception) -> str:
    """Why a port failed, in words for the operator."""
    code = error.errno if isinstance(error, OSError) else None
    if code == errno.ENOENT:
        return "there is no such port (is the adapter plugged in?)"
    if code == errno.EACCES:
        return "permission denied (is the user in the group of serial ports?)"
    if code in (errno.EAGAIN, errno.EBUSY):
        return "another program holds it"
    if isinstance(error, OSError) and error.strerror and not isinstance(error, serial.SerialException):
        return error.strerror[:1].lower() + error.strerror[1:]
    return str(error).rstrip(".")
