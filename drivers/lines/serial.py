"""One line: opened from a URL, written to, and read with a deadline by the caller's parser.

A broken line recovers: the next use opens it again, and reports the cause if that fails.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Literal

from drivers.errors import DeviceError, GarbledReply, LinkLost
from drivers.lines.ports import Opener, Port, open_port, reason
from drivers.lines.traffic import Traffic
from drivers.lines.url import NetAddress, SerialAddress, parse_line_url

Happening = Literal["tx", "rx", "nothing", "broken", "refused"]
"""Bytes sent, bytes received, an empty read without waiting, the text of an error of the open line, or the
error with which it could not be opened.
"""
Recorder = Callable[[Happening, bytes], None]
"""Receives every event on a line immediately, in the thread that causes it."""

XON = b"\x11"
_ECHO_LIMIT_S = 0.1


class SerialLine:
    """A line that stays open, and is opened again after a failure, until it is closed."""

    def __init__(
        self, url: str, *, default_baud: int = 9600, default_format: str = "8N1", flow_control: bool = False
    ) -> None:
        """Read the URL; nothing is opened yet.

        :param flow_control: XON/XOFF, handled by the operating system on serial ports
        :raises BadUrl: one sentence about the error in it
        """
        address = parse_line_url(
            url,
            serial="serial",
            net=("socket", "rfc2217"),
            default_baud=default_baud,
            default_format=default_format,
        )
        self._set_up(address, flow_control=flow_control)

    @classmethod
    def at(cls, address: SerialAddress | NetAddress) -> SerialLine:
        """A line without flow control, for a protocol that has its own URLs."""
        line = cls.__new__(cls)
        line._set_up(address, flow_control=False)
        return line

    def _set_up(self, address: SerialAddress | NetAddress, *, flow_control: bool) -> None:
        self.address = address
        self.recorder: Recorder | None = None
        self.traffic = Traffic()
        self.opener: Opener = open_port
        """Opens its port; a recording may be played back in place of one."""
        self._flow_control = flow_control
        self._port: Port | None = None
        self._wanted = False
        self._unread = b""

    @property
    def notice(self) -> str | None:
        """One sentence to log at start if the line format is overridden, otherwise None."""
        return self.address.notice if isinstance(self.address, SerialAddress) else None

    @property
    def is_open(self) -> bool:
        return self._port is not None

    @property
    def is_played_back(self) -> bool:
        """Whether a wire log answers in place of a device."""
        return self.opener is not open_port

    def open(self) -> None:
        """Open for this process exclusively; open it again after each failure, until it is closed.

        If this fails on a line that was open, its next use tries again.

        :raises LinkLost: the port is missing, busy or unreachable
        :raises DeviceError: the port cannot carry the line format
        """
        self._drop()
        self._opened(first=True)
        self._wanted = True

    def close(self) -> None:
        """Release the port; never raises."""
        self._wanted = False
        self._drop()

    def renew(self) -> None:
        """Call after a missing reply: a connection may have failed silently, so the next use opens a new one.
        A serial port stays open.
        """
        if isinstance(self.address, NetAddress):
            self._drop()

    def interrupt(self) -> None:
        """Make a network reader in another thread stop waiting; from any thread."""
        port = self._port
        if port is not None:
            port.interrupt()

    def write(self, data: bytes) -> None:
        """Send; on a line that echoes, also read the echo.

        :raises LinkLost: the line broke
        :raises GarbledReply: the echo differs from the sent bytes
        """
        port = self._opened()
        try:
            port.write(data)
        except OSError as error:
            raise self._broken("writing", error) from error
        self._record("tx", data)
        if self.address.echo:
            self._take_echo(data)

    def read_some(self, deadline_s: float) -> bytes:
        """The received bytes, at least one; empty once `time.monotonic()` passes the deadline.

        :raises LinkLost: the line broke
        """
        port = self._opened()
        if self._unread:
            data, self._unread = self._unread, b""
            return data
        try:
            at_a_glance = deadline_s <= time.monotonic()
            data = port.read_some(deadline_s)
        except OSError as error:
            raise self._broken("reading", error) from error
        if data or at_a_glance:
            self._record("rx" if data else "nothing", data)
        return data

    def drain(self, seconds: float) -> None:
        """Discard everything that arrives within the next `seconds` (0: only bytes already received).

        :raises LinkLost: the line broke
        """
        deadline_s = time.monotonic() + seconds
        while self.read_some(deadline_s):
            pass

    def refuse_echo(self, sent: bytes, received: bytes) -> None:
        """:raises GarbledReply: the received bytes begin with the sent bytes"""
        if sent and received.startswith(sent):
            raise self.echoes()

    def echoes(self) -> GarbledReply:
        """The error for a line that echoes."""
        return GarbledReply(
            f"{self.address} sends back what it is sent (echo): switch the echo of its adapter off,"
            " or add echo=1 to its address."
        )

    def _take_echo(self, sent: bytes) -> None:
        """Read the echo. It also reveals collisions and noise: the adapter receives what is on the wire."""
        wire_s = 0.0
        if isinstance(self.address, SerialAddress):
            wire_s = len(sent) * self.address.format.bits_per_byte / self.address.baud
        deadline_s = time.monotonic() + wire_s + _ECHO_LIMIT_S
        heard = b""
        while len(heard) < len(sent):
            more = self.read_some(deadline_s)
            if not more:
                raise GarbledReply(
                    f"{self.address} does not echo what it is sent, although its address says echo=1;"
                    " remove that, or check the adapter."
                )
            heard += more
        if heard[: len(sent)] != sent:
            raise GarbledReply(f"{self.address} echoed something else than it was sent; check the line.")
        self._unread = heard[len(sent) :]

    def _opened(self, *, first: bool = False) -> Port:
        if self._port is None:
            if not (first or self._wanted):
                raise DeviceError(f"{self.address} is not open; connect first.")
            try:
                self._port = self.opener(self.address, self._flow_control)
            except DeviceError as error:
                self._record("refused", f"{type(error).__name__} {error}".encode())
                raise
            if self._flow_control:
                self._resume_output(self._port)
        return self._port

    def _resume_output(self, port: Port) -> None:
        """Resume a device: if a program that died had paused it, it would stay silent."""
        try:
            port.write(XON)
        except OSError as error:
            raise self._broken("writing", error) from error
        self._record("tx", XON)

    def _drop(self) -> None:
        self._unread = b""
        if self._port is not None:
            port, self._port = self._port, None
            port.close()

    def _broken(self, while_doing: str, error: OSError) -> LinkLost:
        self._drop()
        why = reason(error)
        self._record("broken", why.encode())
        return LinkLost(f"{self.address} broke while {while_doing}: {why}.")

    def _record(self, what: Happening, data: bytes) -> None:
        self.traffic.note(what)
        if self.recorder is not None:
            self.recorder(what, data)
