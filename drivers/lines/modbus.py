"""One Modbus line with several drives on it: RS-485 (RTU), a TCP gateway, or RTU through a device server.

Nothing is sent twice except reads and stops, replies are checked for kind and length, frames have a gap
between them, a silent link recovers, and a stop overtakes all waiting requests.
"""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from threading import Lock

from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines.lane import Gate
from drivers.lines.modbus_frames import Request, read_request, registers_of, write_one_request, write_request
from drivers.lines.modbus_rtu import RtuLink
from drivers.lines.modbus_tcp import TcpLink
from drivers.lines.on_line import OnLine
from drivers.lines.retrying import within
from drivers.lines.serial import SerialLine
from drivers.lines.url import NetAddress, SerialAddress, parse_line_url

log = logging.getLogger(__name__)

_TCP = "modbus+tcp"
_BUDGET_S = 0.5
_STOP_PAUSE_S = 0.02


class UnansweredWrite(LinkLost):
    """A write was sent without a valid reply: it is unknown whether it was accepted; read the state back."""


class NotSent(LinkLost):
    """The request certainly did not reach the drive."""


class ModbusBus(OnLine):
    """A line shared by its drives; may be called from any thread."""

    def __init__(self, url: str, *, timeout_s: float = 0.3, budget_s: float | None = None) -> None:
        """:param timeout_s: the worst reply time of the drives on the line
        :param budget_s: time limit for repeated reads; by default three time-outs and half a second

        :raises BadUrl: one sentence about the error in `url`
        """
        self.address: SerialAddress | NetAddress = parse_line_url(
            url,
            serial="modbus+rtu",
            net=(_TCP, "modbus+rtuovertcp", "modbus+rfc2217"),
            default_baud=38400,
            default_format="8N2",
        )
        super().__init__(SerialLine.at(self.address))
        if self._line.notice:
            log.warning("%s", self._line.notice)
        over_tcp = url.startswith(f"{_TCP}://")
        self._link: RtuLink | TcpLink = (TcpLink if over_tcp else RtuLink)(self._line, timeout_s)
        self._budget_s = 3 * timeout_s + _BUDGET_S if budget_s is None else budget_s
        self._owners: set[int] = set()
        self._owning = Lock()
        self._sending = Lock()
        self._stops = 0
        self._heard_at_s: dict[int, float] = {}

    def silent_s(self, unit: int) -> float:
        """Time since the last answer of a unit, inf before the first."""
        return time.monotonic() - self._heard_at_s.get(unit, -math.inf)

    @property
    def stops(self) -> int:
        """Number of stops requested so far."""
        return self._stops

    def open(self, owner: object) -> None:
        """Open the line for `owner`; it stays open until its last owner has released it.

        :raises LinkLost: the port or host cannot be reached
        :raises DeviceError: the port cannot carry the line format
        """
        with self._owning:
            if not self._owners:
                self._line.open()
            self._owners.add(id(owner))

    def release(self, owner: object) -> None:
        """Close the line if nobody else uses it; never raises."""
        with self._owning:
            self._owners.discard(id(owner))
            if not self._owners:
                self._link.close()

    def read(self, unit: int, address: int, count: int, *, budget_s: float | None = None) -> list[int]:
        """Holding registers (function 03), requested again when the reply is lost, malformed or "busy".

        :param budget_s: time limit; by default that of the bus
        :return: `count` values 0..65535
        :raises DeviceFault: the drive refuses
        :raises GarbledReply: the reply has the wrong kind or length
        :raises LinkLost: there is no reply
        """
        request = read_request(unit, address, count)
        budget_s = self._budget_s if budget_s is None else budget_s
        return registers_of(within(budget_s, lambda: self._ask(request)))

    def write_one(self, unit: int, address: int, value: int) -> None:
        """One register (function 06), sent once.

        :raises DeviceFault: the drive refuses
        :raises UnansweredWrite: sent, but not confirmed
        :raises LinkLost: not sent
        """
        self._write(write_one_request(unit, address, value))

    def write(self, unit: int, address: int, values: Sequence[int], *, stops_seen: int) -> None:
        """Several registers (function 10h), sent once, unless a stop was requested meanwhile.

        :param stops_seen: `stops` when the decision to send this was taken
        :raises: as `write_one`; DeviceFault also when a stop was requested since
        """

        self._write(write_request(unit, address, values), stops_seen)

    def stop(self, unit: int, address: int, value: int | Sequence[int], *, look_at: int) -> None:
        """A write that stops a drive and overtakes all waiting requests; sent again until confirmed.

        One register is sent with function 06, several with 10h; the same number is read from `look_at` on.

        Repeating a stop is harmless. The reply to function 06 is a copy of the request, which an echoing
        adapter returns too, so the drive's registers at `look_at` have to be readable as well.

        :raises DeviceFault: the drive refuses
        :raises LinkLost: no attempt was confirmed
        """
        with self._sending:  # no write that was decided before this can be sent after it
            self._stops += 1
        try:
            if isinstance(value, int):
                self._stop(write_one_request(unit, address, value), read_request(unit, look_at, 1))
            else:
                self._stop(write_request(unit, address, value), read_request(unit, look_at, len(value)))
        finally:
            with self._owning:
                if not self._owners:
                    self._link.close()

    def _stop(self, request: Request, proof: Request) -> None:
        timeouts_s = list(self._link.stop_timeouts_s)
        until_s = time.monotonic() + sum(timeouts_s)
        causes: list[DeviceError] = []
        while True:
            timeout_s = timeouts_s.pop(0) if len(timeouts_s) > 1 else timeouts_s[0]
            try:
                for step in (request, proof):
                    _check(step, self._link.stop(step, timeout_s, first=not causes))
            except (LinkLost, GarbledReply) as error:
                causes.append(error)
            else:
                return
            if time.monotonic() > until_s:
                raise causes[0]
            time.sleep(_STOP_PAUSE_S)

    def _write(self, request: Request, stops_seen: int | None = None) -> None:
        sent = False

        @contextmanager
        def gate() -> Iterator[None]:
            nonlocal sent
            with self._sending:
                if stops_seen not in (None, self._stops):
                    raise DeviceFault(f"Drive {request.unit} was not given its command: a stop came first.")
                sent = True
                yield

        def attempt() -> None:
            try:
                _check(request, self._exchange(request, gate))
            except NotSent:
                raise
            except (LinkLost, GarbledReply) as error:
                if sent:
                    raise _Uncertain(error) from error
                raise

        try:
            within(self._budget_s, attempt)
        except _Uncertain as uncertain:
            raise UnansweredWrite(
                f"Drive {request.unit} did not confirm a command: {uncertain.cause}"
            ) from uncertain.cause

    def _ask(self, request: Request) -> bytes:
        pdu = self._exchange(request, nullcontext)
        _check(request, pdu)
        return pdu

    def _exchange(self, request: Request, gate: Gate) -> bytes:
        pdu = self._link.exchange(request, gate)
        self._heard_at_s[request.unit] = time.monotonic()
        return pdu


class _Uncertain(Exception):
    """A write must not be repeated: the drive may have accepted it."""

    def __init__(self, cause: DeviceError) -> None:
        super().__init__(str(cause))
        self.cause = cause


def _check(request: Request, pdu: bytes) -> None:
    """:raises DeviceError: the refusal in the reply"""
    if request.is_refused_by(pdu):
        raise _refusal(request.unit, pdu[1])


def _refusal(unit: int, code: int) -> DeviceError:
    match code:
        case 0x01:
            return DeviceFault(f"Drive {unit} does not know the function it was asked for (exception 01).")
        case 0x02:
            return DeviceFault(
                f"Drive {unit} has no such register (exception 02); is it the configured model?"
            )
        case 0x03:
            return DeviceFault(f"Drive {unit} refuses the value or cannot take it now (exception 03).")
        case 0x05:
            return LinkLost(f"Drive {unit} needs longer for its reply (exception 05).")
        case 0x06:
            return NotSent(f"Drive {unit} is busy (exception 06).")
        case 0x08:
            return GarbledReply(
                f"Drive {unit} received a frame with a wrong check sum (exception 08); check the line."
            )
        case 0x0A:
            return NotSent(f"The gateway has no path to drive {unit} (exception 0A); check its settings.")
        case 0x0B:
            return LinkLost(
                f"Drive {unit} does not answer the gateway (exception 0B); check cable, power and address."
            )
    return DeviceFault(f"Drive {unit} answered with exception {code:02X}.")
