"""The far end of a line in tests: exact exchanges, none missing, wrong or left over."""

from __future__ import annotations

import os
import select
import socket
import tempfile
import threading
import time
import tty
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

_PATIENCE_S = 5.0


@dataclass(frozen=True)
class Say:
    """An answer after a pause."""

    data: bytes
    after_s: float = 0.0


SILENCE = b""
NEW_CONNECTION: tuple[bytes, bytes] = (b"", b"")
"""The far end of a network connection accepts the next one before the next exchange."""
Exchange = tuple[bytes, bytes | Say]


def unanswered(exchange: Exchange) -> Exchange:
    """The same request, and silence."""
    return exchange[0], SILENCE


class _FarEnd:
    """Plays exchanges from a thread; leaving the `with` block fails unless all took place exactly."""

    def __init__(self, exchanges: Sequence[Exchange]) -> None:
        self._exchanges = exchanges
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._play)
        self.done = threading.Event()
        """Set when every exchange has taken place."""
        self.failure: str | None = None

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.done.wait(_PATIENCE_S)
        self._closing.set()
        self._thread.join()
        left_over = self._read(0.05) if kind is None and self.failure is None else b""
        self._release()
        if kind is None:
            assert self.failure is None, self.failure
            assert left_over == b"", f"more was sent than expected: {left_over!r}"

    def _play(self) -> None:
        for number, (expected, answer) in enumerate(self._exchanges):
            if not expected:
                self._next_connection()
                continue
            received = b""
            while len(received) < len(expected):
                if self._closing.is_set():
                    self.failure = f"exchange {number} missing: {expected!r}, so far {received!r}"
                    return
                received += self._read(0.02, len(expected) - len(received))
            if received != expected:
                self.failure = f"exchange {number}: {received!r} instead of {expected!r}"
                return
            say = answer if isinstance(answer, Say) else Say(answer)
            time.sleep(say.after_s)
            self._write(say.data)
        self.done.set()

    def _read(self, wait_s: float, most: int = 1000) -> bytes:
        raise NotImplementedError

    def _write(self, data: bytes) -> None:
        raise NotImplementedError

    def _release(self) -> None:
        raise NotImplementedError

    def _next_connection(self) -> None:
        raise NotImplementedError


class PtyEnd(_FarEnd):
    """The far end of a serial line."""

    def __init__(self, exchanges: Sequence[Exchange]) -> None:
        super().__init__(exchanges)
        self._device, self._station = os.openpty()
        tty.setraw(self._station)
        # a number is assigned again at once: reopening a lost port must not find another test's line
        self._names = tempfile.TemporaryDirectory()
        self.port = f"{self._names.name}/port"
        Path(self.port).symlink_to(os.ttyname(self._station))

    def _read(self, wait_s: float, most: int = 1000) -> bytes:
        readable, _, _ = select.select([self._device], [], [], wait_s)
        return os.read(self._device, most) if readable else b""

    def _write(self, data: bytes) -> None:
        os.write(self._device, data)

    def _release(self) -> None:
        self._names.cleanup()
        os.close(self._device)
        os.close(self._station)


class TcpEnd(_FarEnd):
    """The far end of a network connection."""

    def __init__(self, exchanges: Sequence[Exchange]) -> None:
        super().__init__(exchanges)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._listener.settimeout(0.05)
        self.port: int = self._listener.getsockname()[1]
        self._connection: socket.socket | None = None
        self._earlier: list[socket.socket] = []

    def _next_connection(self) -> None:
        """The previous one stays open on this side, as on a host that lost its peer silently."""
        if self._connection is not None:
            self._earlier.append(self._connection)
            self._connection = None

    def _read(self, wait_s: float, most: int = 1000) -> bytes:
        try:
            if self._connection is None:
                self._connection, _ = self._listener.accept()
            self._connection.settimeout(wait_s)
            return self._connection.recv(most)
        except TimeoutError:
            return b""

    def _write(self, data: bytes) -> None:
        assert self._connection is not None
        self._connection.sendall(data)

    def _release(self) -> None:
        self._listener.close()
        for connection in (*self._earlier, self._connection):
            if connection is not None:
                connection.close()


@contextmanager
def echoing_port() -> Iterator[str]:
    """A serial port whose adapter echoes all sent bytes, with no device on the line."""
    device, station = os.openpty()
    tty.setraw(station)
    ended = threading.Event()

    def echo() -> None:
        while not ended.is_set():
            if select.select([device], [], [], 0.01)[0]:
                os.write(device, os.read(device, 256))

    thread = threading.Thread(target=echo)
    thread.start()
    try:
        yield os.ttyname(station)
    finally:
        ended.set()
        thread.join()
        os.close(device)
        os.close(station)


def rtu(text: str) -> bytes:
    """A frame from its bytes in hexadecimal, the check sum appended."""
    frame = bytes.fromhex(text)
    crc = 0xFFFF
    for byte in frame:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0xA001 if crc & 1 else 0)
    return frame + crc.to_bytes(2, "little")
