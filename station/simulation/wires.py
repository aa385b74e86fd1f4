"""Ports with an emulated device at the other end, in virtual time: the bytes are those of real wires."""

from __future__ import annotations

import errno
from collections.abc import Callable

from drivers.emulated.link import DriveReply, DropLink, HalfOpen
from drivers.emulated.modbus_rtu import reply_to
from drivers.emulated.modbus_tcp import HEADER, reply_frame
from drivers.emulated.readout import Reply
from drivers.errors import LinkLost
from drivers.lines import NetAddress, Port, SerialAddress
from station.simulation.scheduler import Killed, Process, Scheduler
from station.simulation.site import SCALE_BAUD, SERVO_BAUD, SERVO_PORT, Site

_BITS = 10
"""Bits of a character on the readout's line."""
_RTU_BITS = 11
_FLOW_CONTROL = bytes((0x11, 0x13))

Drive = Callable[[bytes], DriveReply]


class Wires:
    """The lines of one machine; replaces `open_port`."""

    def __init__(
        self,
        scheduler: Scheduler,
        site: Site,
        readout: Callable[[bytes], list[Reply]],
        drives: dict[int, Drive],
        check_sum_exception: int | None,
    ) -> None:
        """:param check_sum_exception: answer of a drive on RS-485 to a wrong check sum; None: no answer"""
        self._scheduler = scheduler
        self.site, self.drives, self.check_sum_exception = site, drives, check_sum_exception
        self._readout = readout
        self.unplugged = False
        """Whether nothing can be opened, and open lines are broken."""
        self.gateway_free_s = 0.0
        """The gateway queries one drive at a time."""

    def open_port(self, address: SerialAddress | NetAddress, xonxoff: bool) -> Port:
        """As `drivers.lines.ports.open_port`."""
        self._scheduler.give_way()
        if self.unplugged:
            raise LinkLost(f"{address} cannot be reached: no route; check cable, power and address.")
        if isinstance(address, NetAddress):
            return _Connection(self, self._scheduler)
        if address.port == SERVO_PORT:
            return _Rs485(self, self._scheduler)
        return _Readout(self, self._scheduler, self._readout, xonxoff)


class _End:
    """The station's end of a line."""

    def __init__(self, wires: Wires, scheduler: Scheduler) -> None:
        self._wires, self._scheduler = wires, scheduler
        self._process: Process = scheduler.running.process
        self._coming: list[tuple[float, bytes]] = []
        self._broken = False

    def write(self, data: bytes) -> None:
        self._scheduler.give_way()
        if self._process.killed:
            raise Killed
        self._check()
        self._heard(data)

    def read_some(self, deadline_s: float) -> bytes:
        scheduler = self._scheduler
        self._check()
        while not (self._coming and self._coming[0][0] <= scheduler.now_s):
            first_s = min(deadline_s, self._coming[0][0]) if self._coming else deadline_s
            if first_s <= scheduler.now_s:
                return b""
            known = len(self._coming)
            scheduler.wait_until(first_s, lambda: self._gone or len(self._coming) != known)  # noqa: B023
            self._check()
        return self._coming.pop(0)[1]

    def interrupt(self) -> None:
        """Interrupting a serial line has no benefit."""

    def close(self) -> None:
        self._broken = True

    def _heard(self, data: bytes) -> None:
        raise NotImplementedError

    @property
    def _gone(self) -> bool:
        return self._broken or self._wires.unplugged

    def _check(self) -> None:
        if self._gone:
            raise ConnectionResetError(errno.ECONNRESET, "the far end closed the connection")

    def _send(self, data: bytes, after_s: float) -> None:
        """Bytes retain their order: a late one delays all after it."""
        at_s = self._scheduler.now_s + after_s
        self._coming.append((max(at_s, self._coming[-1][0] if self._coming else 0.0), data))


class _Readout(_End):
    def __init__(
        self, wires: Wires, scheduler: Scheduler, receive: Callable[[bytes], list[Reply]], xonxoff: bool
    ) -> None:
        super().__init__(wires, scheduler)
        self._receive = receive
        self._character_s = _BITS / SCALE_BAUD[wires.site.scale]
        self._swallowed = _FLOW_CONTROL if xonxoff else b""

    def _heard(self, data: bytes) -> None:
        for reply in self._receive(data.translate(None, self._swallowed)):
            self._send(reply.data, reply.delay_s + (len(data) + len(reply.data)) * self._character_s)


class _Rs485(_End):
    """Both drives on one line; each frame is written at once."""

    def _heard(self, data: bytes) -> None:
        reply, delay_s = reply_to(data, self._wires.drives, self._wires.check_sum_exception)
        if reply:
            self._send(reply, delay_s + (len(data) + len(reply)) * _RTU_BITS / SERVO_BAUD)


class _Connection(_End):
    """A connection to the gateway."""

    def __init__(self, wires: Wires, scheduler: Scheduler) -> None:
        super().__init__(wires, scheduler)
        self._request = bytearray()
        self._half_open = False

    def interrupt(self) -> None:
        self._broken = True

    def _heard(self, data: bytes) -> None:
        self._request += data
        while len(self._request) >= HEADER.size:
            transaction, _, length, unit = HEADER.unpack_from(self._request)
            if len(self._request) < 6 + length:
                return
            pdu = bytes(self._request[HEADER.size : 6 + length])
            del self._request[: 6 + length]
            if not self._half_open:
                self._ask(transaction, unit, pdu)

    def _ask(self, transaction: int, unit: int, pdu: bytes) -> None:
        try:
            drive = self._wires.drives.get(unit)
            reply = DriveReply(None) if drive is None else drive(pdu)
        except DropLink:
            self._broken = True
            return
        except HalfOpen:
            self._half_open = True
            return
        now_s = self._scheduler.now_s
        busy_s = self._wires.site.trip_s + reply.delay_s
        free_s = self._wires.gateway_free_s = max(now_s, self._wires.gateway_free_s) + busy_s
        self._send(reply_frame(transaction, unit, pdu, reply), free_s - now_s)
