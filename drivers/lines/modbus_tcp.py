"""Modbus TCP: a drive's own connection, or a gateway to a serial line with several drives.

A connection can fail silently (half open), so it is closed after a missing reply and the next request opens
another. A stop never uses an old one: it is sent on a separate connection.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from threading import Lock

from drivers.errors import DeviceError, GarbledReply, LinkLost
from drivers.lines.lane import Gate, Lane
from drivers.lines.modbus_frames import BadHeader, Request, take_tcp_frame
from drivers.lines.serial import SerialLine


class TcpLink:
    """Exchanges with one address; may be called from any thread."""

    def __init__(self, line: SerialLine, timeout_s: float) -> None:
        self.stop_timeouts_s = (timeout_s * 5 / 3, timeout_s * 5 / 3)
        """Time-outs of the attempts to stop. TCP repeats lost data: a missing answer means a slow drive."""
        self._line = line
        self._timeout_s = timeout_s
        self._lane = Lane()
        self._numbers = Lock()
        self._number = 0
        self._busy = False

    def exchange(self, request: Request, gate: Gate) -> bytes:
        """The PDU of the reply.

        :param gate: entered to send the frame; its errors are propagated
        :raises LinkLost: there was no reply, or it was given up for a stop
        :raises GarbledReply: the reply is not a possible one
        """
        with self._lane.hold(urgent=False):
            self._busy = True
            try:
                return self._ask(self._line, request, self._timeout_s, gate)
            except DeviceError:
                self._line.renew()
                raise
            finally:
                self._busy = False

    def stop(self, request: Request, timeout_s: float, *, first: bool) -> bytes:
        """One attempt, which overtakes all waiting requests and a reply in flight. :raises: as `exchange`"""
        if self._busy or not first:  # a gateway that accepts only one connection must be free for this one
            self._line.interrupt()

        @contextmanager
        def noted() -> Iterator[None]:
            yield
            self._line.traffic.note_stop(request.unit)

        line = SerialLine.at(self._line.address)
        line.opener, line.recorder = self._line.opener, self._line.recorder
        try:
            line.open()
            gate = noted if first and not request.is_read else nullcontext
            return self._ask(line, request, timeout_s, gate)
        finally:
            line.close()

    def close(self) -> None:
        with self._lane.hold(urgent=False):
            self._line.close()

    def _ask(self, line: SerialLine, request: Request, timeout_s: float, gate: Gate) -> bytes:
        with self._numbers:
            self._number = number = self._number % 0xFFFF + 1
        line.drain(0)
        with gate():
            line.write(request.tcp(number))
        deadline_s = time.monotonic() + timeout_s
        received = bytearray()
        while more := line.read_some(deadline_s):
            received += more
            try:
                while taken := take_tcp_frame(received):
                    transaction, unit, pdu = taken
                    if transaction != number:
                        continue  # a late reply to an earlier request
                    if unit == request.unit and (request.is_answered_by(pdu) or request.is_refused_by(pdu)):
                        return pdu
                    if pdu == request.pdu:
                        raise line.echoes()
                    raise GarbledReply(
                        f"Drive {request.unit} gave no proper reply on {line.address}:"
                        f" drive {unit} answered {pdu[:16].hex(' ')}; check the gateway and the addresses."
                    )
            except BadHeader:
                raise GarbledReply(
                    f"{line.address} answered {bytes(received[:16]).hex(' ')}, which is not Modbus TCP;"
                    " check the address and the gateway's mode."
                ) from None
        raise LinkLost(
            f"Drive {request.unit} does not answer on {line.address}; check cable, power and address."
        )
