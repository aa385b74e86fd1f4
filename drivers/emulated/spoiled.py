"""Emulated devices as the orders spoil them: what crosses the wire, and what the device itself does."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Final

from drivers.emulated.el7 import EL7Drive
from drivers.emulated.modbus_tcp import DriveReply, DropLink, HalfOpen
from drivers.emulated.nd280 import ND280, Reply
from drivers.emulated.orders import LATE_S, Device, FaultOrder, Kind, Orders

_UNIT_AT, _FUNCTION_AT = 6, 7  # in a Modbus TCP frame
_SLAVE_BUSY = 0x06
_NOISE = bytes.fromhex("00ff55aa")
_VALUE = re.compile(rb"[+-][ 0-9.]{10} .. \r\n|[+-][ 0-9.]{10} ...\r\n")
_ALARMS: tuple[Kind, ...] = ("alarm", "following_error")
_LOSSES: tuple[Kind, ...] = ("lost_counts", "reboot")
_UNIT_OF_VALUE, _FAULT, _INCH = 12, b"?", b'"'


class SpoiledDrive:
    """A drive and its place on the line."""

    def __init__(self, drive: EL7Drive, joint: int, orders: Orders) -> None:
        self._drive = drive
        self._own: Final[Device] = "axis1" if joint == 1 else "axis2"
        self._orders = orders

    def answer(self, request: bytes) -> DriveReply:
        """:raises DropLink: the port is gone; :raises HalfOpen: nothing comes on this connection any more"""
        if self._due("port_gone"):
            raise DropLink
        if self._due("half_open"):
            raise HalfOpen
        if self._due("silent") or self._due("bad_crc"):  # a gateway drops a frame with a wrong check sum
            return DriveReply(None)
        if self._due("echo"):
            return DriveReply(request)
        if refused := self._due("exception"):
            return DriveReply(bytes((request[0] | 0x80, refused.code or _SLAVE_BUSY)))
        self._change_drive()
        reply = DriveReply(self._drive.answer(request))
        if self._due("late"):
            return DriveReply(reply.pdu, LATE_S)
        for kind, spoil in _SPOIL_FRAME.items():
            if self._due(kind):
                return DriveReply(reply.pdu, spoil=spoil)
        return reply

    def _change_drive(self) -> None:
        if not self._orders.hold(_LOSSES, self._own, "line"):
            self._drive.find_reference()
        for kind in _ALARMS:
            if alarmed := self._due(kind):
                self._drive.raise_alarm(alarmed.code)
        self._drive.never_in_position = self._due("never_in_position") is not None
        self._drive.frozen = self._due("frozen") is not None
        if self._due("lost_counts"):
            self._drive.lose_counts()
        if self._due("reboot"):
            self._drive.reboot()

    def _due(self, kind: Kind) -> FaultOrder | None:
        return self._orders.due(kind, self._own, "line")


def _wrong_id(frame: bytes) -> bytes:
    return frame[:_UNIT_AT] + bytes((frame[_UNIT_AT] ^ 0x10,)) + frame[_FUNCTION_AT:]


def _wrong_function(frame: bytes) -> bytes:
    return frame[:_FUNCTION_AT] + bytes((frame[_FUNCTION_AT] ^ 0x07,)) + frame[_FUNCTION_AT + 1 :]


def _short(frame: bytes) -> bytes:
    return frame[:-1]


def _garbage(frame: bytes) -> bytes:
    return _NOISE + frame


def _twice(frame: bytes) -> bytes:
    return frame + frame


_SPOIL_FRAME: Final[dict[Kind, Callable[[bytes], bytes]]] = {
    "wrong_id": _wrong_id,
    "wrong_function": _wrong_function,
    "short": _short,
    "garbage": _garbage,
    "twice": _twice,
}


class ReadoutOnLine:
    """A position display and its line."""

    def __init__(self, display: ND280, orders: Orders) -> None:
        self._display = display
        self._orders = orders
        self._last_value = b""

    def receive(self, data: bytes) -> list[Reply]:
        """As `ND280.receive`, spoiled."""
        if jumped := self._due("jump"):
            self._display.shift(jumped.mm)
        if lost := self._due("lost_counts"):
            self._display.shift(-lost.mm)
        if self._due("reboot"):
            self._display.reboot()
        if self._due("silent") or self._due("port_gone"):
            self._display.receive(data)
            return []
        echo = [Reply(data)] if self._due("echo") else []
        return echo + [self._spoiled(reply) for reply in self._display.receive(data)]

    def _spoiled(self, reply: Reply) -> Reply:
        data, delay_s = reply.data, reply.delay_s
        if _VALUE.fullmatch(data):
            data = self._spoiled_value(data)
        if self._due("late"):
            delay_s = LATE_S
        if self._due("bad_crc"):  # the line has parity only: one character is lost to it
            data = data[:3] + b"\0" + data[4:]
        if self._due("short"):
            data = data[:-3]
        if self._due("garbage"):
            data = _NOISE + data
        if self._due("twice"):
            data += data
        return Reply(data, delay_s)

    def _spoiled_value(self, line: bytes) -> bytes:
        if self._last_value and self._due("frozen"):
            return self._last_value
        self._last_value = line
        if self._due("contaminated") or self._due("overspeed"):
            line = line[:_UNIT_OF_VALUE] + _FAULT + line[_UNIT_OF_VALUE + 1 :]
        if self._due("unit"):
            line = line[:_UNIT_OF_VALUE] + _INCH + line[_UNIT_OF_VALUE + 1 :]
        return line

    def _due(self, kind: Kind) -> FaultOrder | None:
        return self._orders.due(kind, "scale")
