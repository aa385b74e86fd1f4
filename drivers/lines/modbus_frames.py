"""Modbus requests and replies as bytes: protocol data units, RTU frames, TCP frames.

After *Modbus Application Protocol* V1.1b3 (functions 03, 06, 08, 10h, 17h), *Modbus over Serial Line* V1.02
(RTU frame, check sum) and *Modbus Messaging on TCP/IP* V1.0b (header).  Requests and check sums are encoded
by pymodbus; the assignment of received bytes to requests is implemented here.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass

from pymodbus.framer import FramerRTU
from pymodbus.pdu import ModbusPDU
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersRequest,
    WriteMultipleRegistersRequest,
    WriteSingleRegisterRequest,
)

READ = 0x03
_EXCEPTION = 0x80
_HEADER = struct.Struct(">HHHB")  # transaction, protocol, length, unit
_LONGEST_PDU = 253


@dataclass(frozen=True, slots=True)
class Request:
    """A request to one drive, with the beginning and the length of a valid reply."""

    unit: int
    pdu: bytes
    reply_start: bytes
    """The fixed first bytes of a normal reply, function code first."""
    reply_length: int
    """Length of a normal reply's PDU."""

    @property
    def function(self) -> int:
        return self.pdu[0]

    @property
    def is_answered_by_a_copy(self) -> bool:
        """Whether a valid reply cannot be distinguished from an echo, as with function 06."""
        return self.reply_start == self.pdu

    @property
    def is_read(self) -> bool:
        """Whether it changes nothing in the drive."""
        return self.function == READ

    @property
    def rtu(self) -> bytes:
        """The frame on RS-485."""
        return with_check_sum(bytes((self.unit,)) + self.pdu)

    def tcp(self, transaction: int) -> bytes:
        """The frame on TCP."""
        return _HEADER.pack(transaction, 0, len(self.pdu) + 1, self.unit) + self.pdu

    def is_answered_by(self, pdu: bytes) -> bool:
        """Whether a PDU is a normal reply to this, in kind and length."""
        return len(pdu) == self.reply_length and pdu.startswith(self.reply_start)

    def is_refused_by(self, pdu: bytes) -> bool:
        """Whether a PDU is an exception to this."""
        return len(pdu) == 2 and pdu[0] == self.function | _EXCEPTION


def read_request(unit: int, address: int, count: int) -> Request:
    """Holding registers."""
    pdu = _encoded(ReadHoldingRegistersRequest(address=address, count=count))
    return Request(unit, pdu, bytes((READ, 2 * count)), reply_length=2 + 2 * count)


def write_one_request(unit: int, address: int, value: int) -> Request:
    """One register; the reply is a copy."""
    pdu = _encoded(WriteSingleRegisterRequest(address=address, registers=[value]))
    return Request(unit, pdu, pdu, reply_length=5)


def write_request(unit: int, address: int, values: Sequence[int]) -> Request:
    """Several registers."""
    pdu = _encoded(WriteMultipleRegistersRequest(address=address, registers=list(values)))
    return Request(unit, pdu, pdu[:5], reply_length=5)


def _encoded(request: ModbusPDU) -> bytes:
    return bytes((request.function_code,)) + request.encode()


def registers_of(pdu: bytes) -> list[int]:
    """The values of a normal reply to `read_request`."""
    return list(struct.unpack(f">{(len(pdu) - 2) // 2}H", pdu[2:]))


def with_check_sum(frame: bytes) -> bytes:
    """The frame and its CRC, low byte first (Modbus over Serial Line, 6.2.2)."""
    # the library keeps the sum with its bytes in the order of the wire
    return frame + FramerRTU.compute_CRC(frame).to_bytes(2, "big")


def find_rtu_reply(received: bytes, request: Request) -> bytes | None:
    """The PDU of the first whole frame that answers or refuses a request, after any stray bytes.

    A frame is accepted only with its drive's address, its function and a correct check sum.
    """
    for start in range(len(received)):
        if received[start] != request.unit:
            continue
        for length in (request.reply_length, 2):
            pdu = received[start + 1 : start + 1 + length]
            frame = received[start : start + 3 + length]
            fits = request.is_answered_by(pdu) or request.is_refused_by(pdu)
            if fits and len(frame) == length + 3 and with_check_sum(frame[:-2]) == frame:
                return pdu
    return None


def other_rtu_reply(received: bytes, request: Request) -> str | None:
    """The description of a well-formed frame that came in place of the reply; None if there is none."""
    if len(received) < 4:
        return None
    unit, function = received[0], received[1]
    if function == READ:
        length = 5 + received[2]
    elif function & _EXCEPTION:
        length = 5
    else:
        length = 8
    frame = received[:length]
    if len(frame) < length or with_check_sum(frame[:-2]) != frame:
        return None
    if unit != request.unit:
        return f"drive {unit} answered in its place"
    if function == READ == request.function:
        return f"it answered {received[2] // 2} registers instead of {(request.reply_length - 2) // 2}"
    return f"it answered function {function:02X}h instead of {request.function:02X}h, or with other values"


class BadHeader(Exception):
    """A TCP stream is no longer Modbus."""


def take_tcp_frame(received: bytearray) -> tuple[int, int, bytes] | None:
    """Remove the first whole frame: transaction, unit, PDU; None until it is complete.

    :raises BadHeader: no frame begins here; a new connection is required.
    """
    if len(received) < _HEADER.size:
        return None
    transaction, protocol, length, unit = _HEADER.unpack_from(received)
    if protocol != 0 or not 2 <= length <= _LONGEST_PDU + 1:
        raise BadHeader
    end = _HEADER.size + length - 1
    if len(received) < end:
        return None
    pdu = bytes(received[_HEADER.size : end])
    del received[:end]
    return transaction, unit, pdu
