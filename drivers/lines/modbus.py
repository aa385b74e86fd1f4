"""One Modbus line with several drives on it: RS-485 (RTU) or a TCP gateway.

What the client library leaves to its user is done here: nothing is sent twice except reads, a line
on which a reply came late is drained before the next question (RTU frames carry no number, so a
late reply would be taken for the next one), replies are checked for length, frames keep a gap, and
an urgent request passes all waiting ones.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from threading import Condition

from pymodbus import FramerType, ModbusException
from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.pdu import ExceptionResponse, ModbusPDU
from tenacity import Retrying, retry_if_exception_type, stop_after_attempt

from drivers.errors import DeviceFault, GarbledReply, LinkLost
from drivers.lines.serial import Trace, open_serial_port
from drivers.lines.url import NetAddress, SerialAddress, parse_line_url

# Every failure is raised as a sentence of our own; the library's log would say it a second time.
logging.getLogger("pymodbus.logging").setLevel(logging.CRITICAL)

_READ_ATTEMPTS = 3
_LONGEST_FRAME_BYTES = 256
_GAP_BITS = 3.5 * 11
_LEAST_GAP_S = 0.004  # the slowest of the supported drives asks for 3 ms


class UnansweredWrite(LinkLost):
    """A write went out and no proper reply came: it may have taken or not; read the state back."""


class ModbusBus:
    """A line shared by its drives; may be called from any thread."""

    def __init__(self, url: str, *, timeout_s: float = 0.3) -> None:
        """:param timeout_s: the worst reply time of the drives on the line

        :raises BadUrl: one sentence about what is wrong in `url`
        """
        self.address = parse_line_url(
            url, serial="modbus+rtu", net="modbus+tcp", default_baud=38400, default_format="8N2"
        )
        self.trace: Trace | None = None
        """A flight recorder's hook, called with ("tx" or "rx", bytes) while the line is held."""
        self._client = _client(self.address, timeout_s, self._record)
        self._lane = _Lane()
        self._owners: set[int] = set()
        self._gap_s, self._drain_s = 0.0, 0.0
        if isinstance(self.address, SerialAddress):
            bits = self.address.format.bits_per_byte
            self._gap_s = max(_LEAST_GAP_S, _GAP_BITS / self.address.baud)
            self._drain_s = timeout_s + _LONGEST_FRAME_BYTES * bits / self.address.baud
        self._free_from_s = 0.0
        self._stale_until_s = 0.0

    @property
    def notice(self) -> str | None:
        """One sentence to log at start when the line format is overridden, else None."""
        return self.address.notice if isinstance(self.address, SerialAddress) else None

    @property
    def stops(self) -> int:
        """How many urgent requests have been made so far."""
        return self._lane.urgent_count

    def open(self, owner: object) -> None:
        """Open the line for `owner`; it stays open until its last owner has released it.

        :raises LinkLost: the port or host cannot be reached
        :raises DeviceError: the port cannot carry the line format
        """
        with self._lane.hold(urgent=False):
            self._connect()
            self._owners.add(id(owner))

    def release(self, owner: object) -> None:
        """Close the line if nobody else uses it; never raises."""
        with self._lane.hold(urgent=False):
            self._owners.discard(id(owner))
            self._close_if_unused()

    def _close_if_unused(self) -> None:
        """Also after a stop that was sent although nobody had opened the line."""
        if not self._owners:
            with suppress(OSError):  # the cable may be out
                self._client.close()  # type: ignore[no-untyped-call]

    def read(self, unit: int, address: int, count: int) -> list[int]:
        """Holding registers (function 03), asked for again when the reply is lost or malformed.

        :return: `count` values 0..65535
        :raises DeviceFault: the drive refuses
        :raises GarbledReply: a reply of the wrong kind or length
        :raises LinkLost: no reply
        """

        def ask() -> list[int]:
            with self._turn():
                reply = self._ask(
                    unit,
                    lambda: self._client.read_holding_registers(address, count=count, device_id=unit),
                )
                if reply.function_code != 0x03 or len(reply.registers) != count:
                    self._expect_stale_bytes()
                    raise GarbledReply(
                        f"Drive {unit} answered {len(reply.registers)} registers instead of {count}"
                        f" at {address:04X}h; check the line for noise and double addresses."
                    )
                return list(reply.registers)

        return Retrying(
            stop=stop_after_attempt(_READ_ATTEMPTS),
            retry=retry_if_exception_type((GarbledReply, LinkLost)),
            reraise=True,
        )(ask)

    def write_one(self, unit: int, address: int, value: int, *, urgent: bool = False) -> None:
        """One register (function 06), sent once.

        :param urgent: pass all requests that wait for the line
        :raises DeviceFault: the drive refuses
        :raises UnansweredWrite: sent, but not confirmed
        :raises LinkLost: not sent
        """
        self._write(
            unit,
            lambda: self._client.write_register(address, value, device_id=unit),
            lambda reply: (
                reply.function_code == 0x06 and reply.address == address and reply.registers == [value]
            ),
            urgent=urgent,
        )

    def write(self, unit: int, address: int, values: Sequence[int], *, stops_seen: int) -> None:
        """Several registers in one frame (function 10h), sent once.

        :param stops_seen: `stops` when the caller decided to write; if a stop has passed since,
            the frame is not sent, so that no queued move can follow a stop
        :raises DeviceFault: the drive refuses, or a stop came first
        :raises UnansweredWrite: sent, but not confirmed
        :raises LinkLost: not sent
        """
        self._write(
            unit,
            lambda: self._client.write_registers(address, list(values), device_id=unit),
            lambda reply: (
                reply.function_code == 0x10 and reply.address == address and reply.count == len(values)
            ),
            stops_seen=stops_seen,
        )

    def _write(
        self,
        unit: int,
        send: Callable[[], ModbusPDU],
        confirms: Callable[[ModbusPDU], bool],
        *,
        urgent: bool = False,
        stops_seen: int | None = None,
    ) -> None:
        with self._turn(urgent=urgent):
            if stops_seen is not None and stops_seen != self.stops:
                raise DeviceFault(f"Drive {unit} was not given its command: a stop came first.")
            self._connect()
            try:
                reply = self._ask(unit, send)
            except _PathClosed:
                raise
            except (LinkLost, GarbledReply) as error:
                raise UnansweredWrite(f"Drive {unit} did not confirm a command: {error}") from error
            if not confirms(reply):
                self._expect_stale_bytes()
                raise UnansweredWrite(
                    f"Drive {unit} confirmed another command than it was given; check the line."
                )

    def _ask(self, unit: int, send: Callable[[], ModbusPDU]) -> ModbusPDU:
        """One exchange, in one's turn."""
        self._connect()
        time.sleep(max(0.0, self._free_from_s - time.monotonic()))
        try:
            reply = send()
        except (ModbusException, OSError) as error:
            self._expect_stale_bytes()
            raise LinkLost(
                f"Drive {unit} does not answer on {self.address}; check cable, power and address."
            ) from error
        finally:
            self._free_from_s = time.monotonic() + self._gap_s
        if isinstance(reply, ExceptionResponse):
            raise _refusal(unit, reply.exception_code)
        return reply

    def _connect(self) -> None:
        if self._client.connect():
            return
        if isinstance(self.address, SerialAddress):
            open_serial_port(self.address, xonxoff=False).close()  # says what the library only logs
        raise LinkLost(f"{self.address} cannot be reached; check cable, power and address.")

    def _expect_stale_bytes(self) -> None:
        self._stale_until_s = time.monotonic() + self._drain_s

    @contextmanager
    def _turn(self, *, urgent: bool = False) -> Iterator[None]:
        """The line for one exchange, clean of late replies.

        On RS-485 that means waiting until none can come any more, without holding the line: a stop
        goes out at once, since whatever may arrive then only leaves it unconfirmed.
        """
        while True:
            if not urgent:
                time.sleep(max(0.0, self._stale_until_s - time.monotonic()))
            with self._lane.hold(urgent=urgent):
                if urgent or time.monotonic() >= self._stale_until_s:
                    self._client.discard()
                    try:
                        yield
                    finally:
                        self._close_if_unused()
                    return

    def _record(self, direction: str, data: bytes) -> None:
        if self.trace is not None and data:
            self.trace("tx" if direction == "tx" else "rx", data)


class _PathClosed(LinkLost):
    """The gateway says that it could not even send the request."""


class _Lane:
    """A lock whose urgent callers pass all that wait; ordinary ones wait while an urgent one does."""

    def __init__(self) -> None:
        self._changed = Condition()
        self._busy = False
        self._urgent_waiting = 0
        self.urgent_count = 0

    @contextmanager
    def hold(self, *, urgent: bool) -> Iterator[None]:
        with self._changed:
            self._urgent_waiting += urgent
            self.urgent_count += urgent
            self._changed.wait_for(lambda: not self._busy and (urgent or not self._urgent_waiting))
            self._urgent_waiting -= urgent
            self._busy = True
        try:
            yield
        finally:
            with self._changed:
                self._busy = False
                self._changed.notify_all()


Record = Callable[[str, bytes], None]


class _TcpClient(ModbusTcpClient):
    """The library's client with what really crosses the wire shown to the recorder."""

    def __init__(self, address: NetAddress, timeout_s: float, record: Record) -> None:
        super().__init__(address.host, port=address.port, timeout=timeout_s, retries=0)
        self._record = record

    def send(self, request: bytes, addr: tuple[str, int] | None = None) -> int:
        self._record("tx", request)
        return int(super().send(request, addr))

    def recv(self, size: int | None) -> bytes:
        data = super().recv(size)
        self._record("rx", data)
        return data

    def discard(self) -> None:
        """Nothing to do: each reply carries the number of its request."""


class _SerialClient(ModbusSerialClient):
    """The same on RS-485."""

    def __init__(self, address: SerialAddress, timeout_s: float, record: Record) -> None:
        line_format = address.effective_format
        super().__init__(
            address.port,
            framer=FramerType.RTU,
            baudrate=address.baud,
            bytesize=line_format.data_bits,
            parity=line_format.parity,
            stopbits=line_format.stop_bits,
            timeout=timeout_s,
            retries=0,
        )
        self._record = record

    def send(self, request: bytes, addr: tuple[str, int] | None = None) -> int:
        self._record("tx", request)
        return int(super().send(request, addr))

    def recv(self, size: int | None) -> bytes:
        data = super().recv(size)
        self._record("rx", data)
        return data

    def discard(self) -> None:
        """Throw away what has come in, so that it is not taken for a reply."""
        if self.socket is None:
            return
        try:
            if waiting := self.socket.in_waiting:
                self._record("rx", self.socket.read(waiting))
        except OSError:  # the line broke; the request that follows opens it again or says so
            self.close()  # type: ignore[no-untyped-call]


def _client(
    address: SerialAddress | NetAddress, timeout_s: float, record: Record
) -> _TcpClient | _SerialClient:
    if isinstance(address, NetAddress):
        return _TcpClient(address, timeout_s, record)
    return _SerialClient(address, timeout_s, record)


def _refusal(unit: int, code: int) -> DeviceFault | GarbledReply | LinkLost:
    match code:
        case 0x01:
            return DeviceFault(f"Drive {unit} does not know the function it was asked for (exception 01).")
        case 0x02:
            return DeviceFault(
                f"Drive {unit} has no such register (exception 02); is it the configured model?"
            )
        case 0x03:
            return DeviceFault(f"Drive {unit} refuses the value or cannot take it now (exception 03).")
        case 0x08:
            return GarbledReply(
                f"Drive {unit} received a frame with a wrong check sum (exception 08); check the line."
            )
        case 0x0A:
            return _PathClosed(f"The gateway has no path to drive {unit} (exception 0A); check its settings.")
        case 0x0B:
            return LinkLost(
                f"Drive {unit} does not answer the gateway (exception 0B); check cable, power and address."
            )
    return DeviceFault(f"Drive {unit} answered with exception {code:02X}.")
