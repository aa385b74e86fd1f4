"""Emulated devices with the ordered faults: of the wire, and of the device itself."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

from drivers.emulated.drive import EmulatedDrive
from drivers.emulated.input_module import InputModule
from drivers.emulated.link import DriveReply, DropLink, HalfOpen
from drivers.emulated.orders import LATE_S, Device, FaultOrder, Kind, Orders
from drivers.emulated.readout import EmulatedReadout, Reply

_SLAVE_BUSY = 0x06
_NOISE = bytes.fromhex("00ff55aa")
_ALARMS: tuple[Kind, ...] = ("alarm", "following_error")
_LOSSES: tuple[Kind, ...] = ("lost_counts", "reboot")


class _Unit(ABC):
    """A unit on the line, and its address."""

    def __init__(self, own: Device, orders: Orders, *, behind_gateway: bool) -> None:
        self._behind_gateway = behind_gateway
        self._on_the_way = tuple(k for k in _ON_THE_WAY if k != "bad_crc" or not behind_gateway)
        self._own: Final = own
        self._orders = orders
        self._spoiled = False
        """Whether a fault was ordered at the last request."""

    def answer(self, request: bytes) -> DriveReply:
        """:raises DropLink: the port is gone; :raises HalfOpen: this connection stays silent from now on"""
        was_spoiled, self._spoiled = self._spoiled, bool(self._orders.given)
        if not self._spoiled:  # the usual case
            if was_spoiled:
                self._change()
            return DriveReply(self._answer(request))
        if self._due("port_gone"):
            raise DropLink
        if self._due("half_open"):
            raise HalfOpen
        # a gateway drops a frame with a wrong check sum
        if self._due("silent") or (self._behind_gateway and self._due("bad_crc")):
            return DriveReply(None)
        if self._due("echo"):
            return DriveReply(request)
        if refused := self._due("exception"):
            return DriveReply(bytes((request[0] | 0x80, refused.code or _SLAVE_BUSY)))
        self._change()
        reply = DriveReply(self._answer(request))
        if self._due("late"):
            return DriveReply(reply.pdu, LATE_S)
        for kind in self._on_the_way:
            if self._due(kind):
                return DriveReply(reply.pdu, spoil=kind)
        return reply

    @abstractmethod
    def _answer(self, request: bytes) -> bytes:
        """The device's own answer."""

    @abstractmethod
    def _change(self) -> None:
        """Apply the ordered faults to the device."""

    def _due(self, kind: Kind) -> FaultOrder | None:
        return self._orders.due(kind, self._own, "line")


class SpoiledDrive(_Unit):
    """A drive."""

    def __init__(
        self, drive: EmulatedDrive, joint: int, orders: Orders, *, behind_gateway: bool = True
    ) -> None:
        super().__init__("axis1" if joint == 1 else "axis2", orders, behind_gateway=behind_gateway)
        self._drive = drive

    def _answer(self, request: bytes) -> bytes:
        return self._drive.answer(request)

    def _change(self) -> None:
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


class SpoiledInputs(_Unit):
    """The input module."""

    def __init__(self, module: InputModule, orders: Orders, *, behind_gateway: bool = True) -> None:
        super().__init__("inputs", orders, behind_gateway=behind_gateway)
        self._module = module

    def _answer(self, request: bytes) -> bytes:
        return self._module.answer(request)

    def _change(self) -> None:
        self._module.door_open = self._due("door_open") is not None
        shown = self._due("temperature")
        self._module.shown_c = None if shown is None else shown.temperature_c


_ON_THE_WAY: tuple[Kind, ...] = ("wrong_id", "wrong_function", "bad_crc", "short", "garbage", "twice")


class ReadoutOnLine:
    """A readout and its line."""

    def __init__(self, display: EmulatedReadout, orders: Orders) -> None:
        self._display = display
        self._orders = orders
        self._last_value = b""

    def receive(self, data: bytes) -> list[Reply]:
        """As `ND280.receive`, disturbed."""
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
        if self._display.is_value(data):
            data = self._spoiled_value(data)
        if self._due("late"):
            delay_s = LATE_S
        if self._due("bad_crc"):  # the line has only parity: one character is lost
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
            return self._display.marked_faulty(line)
        if self._due("unit"):
            return self._display.in_other_unit(line)
        return line

    def _due(self, kind: Kind) -> FaultOrder | None:
        return self._orders.due(kind, "scale")
