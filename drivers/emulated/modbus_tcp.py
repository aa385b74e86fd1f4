"""A Modbus TCP gateway with several drives on the serial line behind it."""

from __future__ import annotations

import socket
import struct
from collections.abc import Callable, Mapping
from contextlib import suppress
from threading import Event, Lock, Thread

from drivers.emulated.link import DriveReply, DropLink, HalfOpen, Kind

_TARGET_SILENT = 0x0B
HEADER = struct.Struct(">HHHB")  # transaction, protocol, length, unit
_LONGEST_PDU = 253
_UNIT_AT, _FUNCTION_AT = 6, 7
_NOISE = bytes.fromhex("00ff55aa")


class ModbusTcpGateway:
    """Listens on a free port of 127.0.0.1 until closed; one request at a time, as on a line.

    :param units: drive address -> request PDU in, reply out
    """

    def __init__(self, units: Mapping[int, Callable[[bytes], DriveReply]]) -> None:
        self._units = units
        self._line = Lock()
        self._closing = Event()
        self._connections: list[tuple[socket.socket, Thread]] = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        self._thread = Thread(target=self._accept, name=f"emulated gateway on port {self.port}")
        self._thread.start()

    def close(self) -> None:
        """Close all connections and stop all threads."""
        self._closing.set()
        _shut(self._listener)
        self._thread.join()
        for connection, thread in self._connections:
            _shut(connection)
            thread.join()

    def _accept(self) -> None:
        while not self._closing.is_set():
            try:
                connection, _ = self._listener.accept()
            except OSError:
                return  # closed
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            thread = Thread(target=self._serve, args=(connection,), name="emulated gateway connection")
            self._connections = [entry for entry in self._connections if entry[1].is_alive()]
            self._connections.append((connection, thread))
            thread.start()

    def _serve(self, connection: socket.socket) -> None:
        dead = False
        with connection, suppress(OSError, DropLink):
            while frame := _read_frame(connection):
                if dead:
                    continue
                transaction, unit, pdu = frame
                try:
                    with self._line:
                        reply = self._ask(unit, pdu)
                except HalfOpen:
                    dead = True
                    continue
                connection.sendall(reply_frame(transaction, unit, pdu, reply))

    def _ask(self, unit: int, pdu: bytes) -> DriveReply:
        drive = self._units.get(unit)
        reply = DriveReply(None) if drive is None else drive(pdu)
        self._closing.wait(reply.delay_s)
        return reply


def reply_frame(transaction: int, unit: int, request: bytes, reply: DriveReply) -> bytes:
    """The answer of the gateway to a request PDU; also for a silent drive, and disturbed if so ordered."""
    answer = bytes((request[0] | 0x80, _TARGET_SILENT)) if reply.pdu is None else reply.pdu
    whole = HEADER.pack(transaction, 0, len(answer) + 1, unit) + answer
    return _SPOIL[reply.spoil](whole) if reply.spoil else whole


def _read_frame(connection: socket.socket) -> tuple[int, int, bytes] | None:
    """Transaction, unit and PDU of the next request; None at the end or after invalid data."""
    header = _read_exactly(connection, HEADER.size)
    if header is None:
        return None
    transaction, protocol, length, unit = HEADER.unpack(header)
    if protocol != 0 or not 2 <= length <= _LONGEST_PDU + 1:
        return None
    pdu = _read_exactly(connection, length - 1)
    return None if pdu is None else (transaction, unit, pdu)


def _read_exactly(connection: socket.socket, count: int) -> bytes | None:
    data = b""
    while len(data) < count:
        more = connection.recv(count - len(data))
        if not more:
            return None
        data += more
    return data


def _shut(connection: socket.socket) -> None:
    """Close a socket even while another thread waits on it."""
    with suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)
    connection.close()


def _changed(frame: bytes, at: int, by: int) -> bytes:
    return frame[:at] + bytes((frame[at] ^ by,)) + frame[at + 1 :]


_SPOIL: dict[Kind, Callable[[bytes], bytes]] = {
    "wrong_id": lambda frame: _changed(frame, _UNIT_AT, 0x10),
    "wrong_function": lambda frame: _changed(frame, _FUNCTION_AT, 0x07),
    "short": lambda frame: frame[:-1],
    "garbage": lambda frame: _NOISE + frame,
    "twice": lambda frame: frame + frame,
}
