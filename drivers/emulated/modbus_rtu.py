"""An RS-485 line with several drives on it, on a pseudo-terminal, with real transmission times.

A frame ends where the line is silent for 3.5 characters; a character takes its bits at the baud rate.  The
answer to a wrong check sum depends on the drive's family; frames for others are not answered.
"""

from __future__ import annotations

import os
import select
import time
import tty
from collections.abc import Callable, Mapping
from threading import Event, Thread

from drivers.emulated.link import DriveReply, DropLink, HalfOpen, Kind

_BITS = 11
_SILENCE_BYTES = 3.5
_LEAST_SILENCE_S = 0.00175
"""Above 19200 baud (Modbus over Serial Line, 2.5.1.1)."""
_REPLY_DELAY_S = 0.001
_SLICE_S = 0.001
_NOISE = bytes.fromhex("00ff55aa")


class RtuLine:
    """Serves until closed.

    :param units: drive address -> request PDU in, reply out
    :param check_sum_exception: answer of a drive to a frame with a wrong check sum; None: no answer
    """

    def __init__(
        self,
        units: Mapping[int, Callable[[bytes], DriveReply]],
        *,
        baud: int,
        check_sum_exception: int | None,
    ) -> None:
        self._units = units
        self._check_sum_exception = check_sum_exception
        self._byte_s = _BITS / baud
        self._silence_s = max(_LEAST_SILENCE_S, _SILENCE_BYTES * self._byte_s)
        self._device, self._station = os.openpty()
        tty.setraw(self._station)  # kept open here, so that the line survives the station's closing it
        self.port = os.ttyname(self._station)
        self._closing = Event()
        self._thread = Thread(target=self._serve, name=f"emulated RS-485 line on {self.port}")
        self._thread.start()

    def close(self) -> None:
        """Stop the thread and free the pseudo-terminal."""
        self._closing.set()
        self._thread.join()
        os.close(self._device)
        os.close(self._station)

    def _serve(self) -> None:
        while not self._closing.is_set():
            frame = self._next_frame()
            if frame:
                time.sleep(len(frame) * self._byte_s)  # a pseudo-terminal delivers all of it at once
                self._send(self._answer(frame))

    def _next_frame(self) -> bytes:
        """The bytes up to a silence; empty if nothing came for a while."""
        received = b""
        wait_s = 0.05
        while select.select([self._device], [], [], wait_s)[0]:
            received += os.read(self._device, 256)
            wait_s = self._silence_s
        return received

    def _answer(self, frame: bytes) -> bytes:
        reply, delay_s = reply_to(frame, self._units, self._check_sum_exception)
        self._closing.wait(delay_s)
        return reply

    def _send(self, data: bytes) -> None:
        """Send byte after byte, in slices that the scheduler can time."""
        began_s, sent = time.monotonic(), 0
        while sent < len(data) and not self._closing.is_set():
            due = min(len(data), int((time.monotonic() - began_s) / self._byte_s))
            if due > sent:
                os.write(self._device, data[sent:due])
                sent = due
            else:
                time.sleep(_SLICE_S)


def reply_to(
    frame: bytes, units: Mapping[int, Callable[[bytes], DriveReply]], check_sum_exception: int | None
) -> tuple[bytes, float]:
    """The answer of the drives on a line to a frame, and its delay; empty: no answer."""
    unit = units.get(frame[0]) if len(frame) >= 4 else None
    if unit is None:
        return b"", 0.0
    pdu = frame[1:-2]
    if check_sum(frame[:-2]) != frame[-2:]:
        if check_sum_exception is None:
            return b"", 0.0
        return framed(bytes((frame[0], pdu[0] | 0x80, check_sum_exception))), 0.0
    try:
        reply = unit(pdu)
    except (DropLink, HalfOpen):
        return b"", 0.0  # the line has no connection: no answer
    if reply.pdu is None:
        return b"", 0.0
    whole = framed(frame[:1] + reply.pdu)
    return (_SPOIL[reply.spoil](whole) if reply.spoil else whole), _REPLY_DELAY_S + reply.delay_s


def check_sum(frame: bytes) -> bytes:
    """CRC, low byte first; computed here, so that drivers and emulation share no implementation."""
    crc = 0xFFFF
    for byte in frame:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0xA001 if crc & 1 else 0)
    return crc.to_bytes(2, "little")


def framed(frame: bytes) -> bytes:
    """The frame with its check sum."""
    return frame + check_sum(frame)


def _changed(frame: bytes, at: int, by: int) -> bytes:
    return framed(frame[:at] + bytes((frame[at] ^ by,)) + frame[at + 1 : -2])


_SPOIL: dict[Kind, Callable[[bytes], bytes]] = {
    "wrong_id": lambda frame: _changed(frame, 0, 0x10),
    "wrong_function": lambda frame: _changed(frame, 1, 0x07),
    "bad_crc": lambda frame: frame[:-1] + bytes((frame[-1] ^ 0xFF,)),
    "short": lambda frame: frame[:-1],
    "garbage": lambda frame: _NOISE + frame,
    "twice": lambda frame: frame + frame,
}
