"""libmodbus, from Debian's mbpoll, as a master and as a slave: an independent implementation."""

from __future__ import annotations

import ctypes
import os
import select
import socket
import threading
import tty
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

_LONGEST = 260
_PATIENCE_US = 200_000


def _load() -> ctypes.CDLL | None:
    try:
        library = ctypes.CDLL("libmodbus.so.5", use_errno=True)
    except OSError:
        return None
    for name in ("modbus_new_tcp", "modbus_new_rtu", "modbus_mapping_new"):
        getattr(library, name).restype = ctypes.c_void_p
    library.modbus_strerror.restype = ctypes.c_char_p
    return library


LIBRARY = _load()


class _Mapping(ctypes.Structure):
    """`modbus_mapping_t`."""

    _fields_ = (
        *((name, ctypes.c_int) for name in ("nb_bits", "start_bits", "nb_input_bits", "start_input_bits")),
        *((name, ctypes.c_int) for name in ("nb_input_registers", "start_input_registers")),
        *((name, ctypes.c_int) for name in ("nb_registers", "start_registers")),
        *((name, ctypes.c_void_p) for name in ("tab_bits", "tab_input_bits", "tab_input_registers")),
        ("tab_registers", ctypes.POINTER(ctypes.c_uint16)),
    )


class Refused(Exception):
    """libmodbus's error of an exchange."""


def _library() -> ctypes.CDLL:
    assert LIBRARY is not None
    return LIBRARY


@contextmanager
def _context(where: str | int, unit: int) -> Iterator[ctypes.c_void_p]:
    """:param where: a port of 127.0.0.1, or a serial port at 38400 8N2"""
    library = _library()
    if isinstance(where, int):
        found = library.modbus_new_tcp(b"127.0.0.1", where)
    else:
        found = library.modbus_new_rtu(where.encode(), 38400, ctypes.c_char(b"N"), 8, 2)
    context = ctypes.c_void_p(found)
    library.modbus_set_slave(context, unit)
    try:
        yield context
    finally:
        library.modbus_close(context)
        library.modbus_free(context)


class Master:
    """One connection to one unit."""

    def __init__(self, context: ctypes.c_void_p) -> None:
        self._context = context

    def read(self, address: int, count: int) -> list[int]:
        """Function 03.  :raises Refused:"""
        values = (ctypes.c_uint16 * count)()
        self._done(_library().modbus_read_registers(self._context, address, count, values))
        return list(values)

    def write(self, address: int, values: Sequence[int]) -> None:
        """Function 10h.  :raises Refused:"""
        words = (ctypes.c_uint16 * len(values))(*values)
        self._done(_library().modbus_write_registers(self._context, address, len(values), words))

    def write_one(self, address: int, value: int) -> None:
        """Function 06.  :raises Refused:"""
        self._done(_library().modbus_write_register(self._context, address, value))

    def _done(self, result: int) -> None:
        if result < 0:
            raise Refused(_library().modbus_strerror(ctypes.get_errno()).decode())


@contextmanager
def master(where: str | int, unit: int) -> Iterator[Master]:
    """Connected.  :param where: a port of 127.0.0.1, or a serial port"""
    with _context(where, unit) as context:
        assert _library().modbus_connect(context) == 0
        yield Master(context)


class Slave:
    """Registers from 0 on, served until it is told to end."""

    def __init__(self, context: ctypes.c_void_p, registers: int) -> None:
        library = _library()
        self._context = context
        self._place = ctypes.c_void_p(library.modbus_mapping_new(0, 0, registers, 0))
        self._mapping = ctypes.cast(self._place, ctypes.POINTER(_Mapping)).contents
        self.ended = threading.Event()

    def __getitem__(self, address: int) -> int:
        return int(self._mapping.tab_registers[address])

    def __setitem__(self, address: int, value: int) -> None:
        self._mapping.tab_registers[address] = value

    def serve(self) -> None:
        """Serve requests on the open line, until it breaks or the end."""
        library, query = _library(), (ctypes.c_uint8 * _LONGEST)()
        library.modbus_set_indication_timeout(self._context, 0, _PATIENCE_US)
        while not self.ended.is_set():
            length = library.modbus_receive(self._context, query)
            if length > 0:
                library.modbus_reply(self._context, query, length, self._place)
            elif length < 0 and ctypes.get_errno() == 104:  # the connection was reset
                return

    def free(self) -> None:
        _library().modbus_mapping_free(self._place)


@contextmanager
def tcp_slave(registers: int) -> Iterator[tuple[Slave, int]]:
    """Answers on the given port; one connection at a time, as small gateways do."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    with _context(port, 1) as context:
        slave = Slave(context, registers)
        listener = socket.socket(fileno=_library().modbus_tcp_listen(context, 5))
        listener.settimeout(0.05)

        def serve() -> None:
            while not slave.ended.is_set():
                with suppress(TimeoutError):
                    connection, _ = listener.accept()
                    with connection:
                        connection.setblocking(True)
                        _library().modbus_set_socket(context, connection.fileno())
                        slave.serve()

        with _running(serve, slave):
            yield slave, port
        listener.close()


@contextmanager
def rtu_slave(unit: int, registers: int) -> Iterator[tuple[Slave, str]]:
    """Answers at the far end of the given serial port."""
    with crossed_ports() as (near, far), _context(far, unit) as context:
        assert _library().modbus_connect(context) == 0
        slave = Slave(context, registers)
        with _running(slave.serve, slave):
            yield slave, near


@contextmanager
def _running(serve: object, slave: Slave) -> Iterator[None]:
    assert callable(serve)
    thread = threading.Thread(target=serve)
    thread.start()
    try:
        yield
    finally:
        slave.ended.set()
        thread.join()
        slave.free()


@contextmanager
def crossed_ports() -> Iterator[tuple[str, str]]:
    """Two serial ports; bytes written to one arrive at the other."""
    ends = [os.openpty(), os.openpty()]
    for _, station in ends:
        tty.setraw(station)
    masters = [ends[0][0], ends[1][0]]
    ended = threading.Event()

    def relay() -> None:
        while not ended.is_set():
            for readable in select.select(masters, [], [], 0.02)[0]:
                other = masters[1] if readable == masters[0] else masters[0]
                os.write(other, os.read(readable, 512))

    thread = threading.Thread(target=relay)
    thread.start()
    try:
        yield os.ttyname(ends[0][1]), os.ttyname(ends[1][1])
    finally:
        ended.set()
        thread.join()
        for pair in ends:
            for descriptor in pair:
                os.close(descriptor)


def device(url: str) -> str | int:
    """Address of the drives of an emulated rig, in the form for `master`."""
    place = url.partition("://")[2].partition("?")[0]
    return place if Path(place).is_absolute() else int(place.rpartition(":")[2])
