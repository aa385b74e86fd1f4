"""SIKO absolute reading heads MSA501, MSA510/1, MSAC501 with the SIKONETZ3 protocol on RS-485.

A telegram is address, command, for some commands three bytes of data (low byte first), and the exclusive or
of all previous bytes.  The master's short telegrams have bit 7 of the address set.  Instead of a position the
head answers error 83h if the gap to the tape is too large, the absolute value implausible, or the speed above
5 m/s.

An exclusive or does not detect two flipped bits of one weight, so a position is accepted only if it is read
twice, or, while the head moves, if it lies between those read directly before and after it.
"""

from __future__ import annotations

import time
from typing import Annotated

from pydantic import Field

from drivers.driver import DriverSettings, ScaleDriver, Seconds
from drivers.errors import DeviceError, DeviceFault, GarbledReply, LinkLost
from drivers.lines import SerialLine
from drivers.scales.readout import Readout

READ_POSITION, IDENTIFY, READ_RESOLUTION = 0x16, 0x1B, 0x1E
CHECK_SUM_ERROR, REFUSED, ILLEGAL_VALUE = 0x82, 0x83, 0x85
_COMMANDS = {
    READ_POSITION: "position",
    IDENTIFY: "type and firmware",
    READ_RESOLUTION: "resolution",
    CHECK_SUM_ERROR: "received a wrong check byte",
    REFUSED: "refuses, or cannot measure",
    ILLEGAL_VALUE: "refuses the value",
}
_SHORT = 0x80
_SHORT_LENGTH, _LONG_LENGTH = 3, 6
_TYPES = {34: "MSA501", 23: "MSA510/1", 21: "MA501"}
_WITH_RESOLUTION = 23
_RESOLUTIONS_MM = {0: 10.0, 1: 1.0, 2: 0.1, 3: 0.01}
_SILENCE_S = 0.03
"""Silence after a missing reply."""
_AGREEMENT_COUNTS = 2
_MOST_READS = 5


class SikoSettings(DriverSettings):
    """Options of `protocol = "siko"`."""

    address: Annotated[int, Field(ge=1, le=31)] = 1
    """Address of the head on its line."""
    resolution_mm: Annotated[float, Field(gt=0, le=10)] = 0.01
    """Length of one count, as set in the head: 0.01 or 0.005."""
    timeout_s: Seconds = 0.2
    """Longest time that a reply may take."""


class SikoHead(Readout):
    """A reading head as a `LinearScale`; may be called from any thread."""

    def __init__(
        self, settings: SikoSettings, *, name: str = "linear scale", budget_s: float | None = None
    ) -> None:
        """:param budget_s: time limit for repeated requests; by default three time-outs and half a second

        :raises BadUrl: one sentence about the error in the URL
        """
        line = SerialLine(settings.url, default_baud=19200, default_format="8N1")
        super().__init__(line, name=name, timeout_s=settings.timeout_s, budget_s=budget_s)
        self._address = settings.address
        self._resolution_mm = settings.resolution_mm
        self._free_from_s = 0.0
        self._identity = ""

    @property
    def identity(self) -> str:
        """Type and firmware that the head returned at `connect`."""
        return self._identity

    def connect(self) -> None:
        """Open the line, read the type, and compare the resolution if the head reports it.

        :raises DeviceError: with the error and what to check
        """
        with self._lock:
            self._line.open()
            try:
                kind, firmware, _ = self._ask(IDENTIFY)
                self._identity = f"{_TYPES.get(kind, f'type {kind}')}, firmware {firmware}"
                if kind == _WITH_RESOLUTION:
                    self._check_resolution()
                self.read_mm()
            except DeviceError:
                self._line.close()
                raise

    def read_mm(self) -> float:
        """The head's present value in mm.

        :raises DeviceFault: the head reports that it cannot measure
        :raises GarbledReply: there was no valid reply, or no two that agree
        :raises LinkLost: there is no answer
        """
        with self._lock:
            counts = [self._position()]
            while len(counts) < _MOST_READS:
                counts.append(self._position())
                if abs(counts[-1] - counts[-2]) <= _AGREEMENT_COUNTS:
                    return counts[-1] * self._resolution_mm
                if len(counts) > 2 and counts[-2] == sorted(counts[-3:])[1]:
                    return counts[-2] * self._resolution_mm  # it moves; reads need not be equally spaced
        raise GarbledReply(
            f"The {self._name} answered {', '.join(f'{count}' for count in counts)} counts in a row;"
            " check the line for noise, and whether the head stands still."
        )

    def _position(self) -> int:
        low, mid, high = self._ask(READ_POSITION)
        return int.from_bytes(bytes((low, mid, high)), "little", signed=True)

    def _check_resolution(self) -> None:
        code, _, _ = self._ask(READ_RESOLUTION)
        resolution_mm = _RESOLUTIONS_MM.get(code)
        if resolution_mm != self._resolution_mm:
            says = "inches" if resolution_mm is None else f"{resolution_mm:g} mm"
            raise DeviceFault(
                f"The {self._name} counts in {says}, the station file says resolution_mm ="
                f" {self._resolution_mm:g}; correct one of them."
            )

    def _ask(self, command: int) -> tuple[int, int, int]:
        """The three data bytes of the reply to a short telegram."""
        return self._retried(lambda: self._exchange(command))

    def _prepare(self) -> None:
        """Ensure that a late reply does not answer the next request."""
        self._line.drain(max(0.0, self._free_from_s - time.monotonic()))

    def _has_failed(self) -> None:
        self._free_from_s = time.monotonic() + _SILENCE_S

    def _exchange(self, command: int) -> tuple[int, int, int]:
        request = with_check_byte(bytes((self._address | _SHORT, command)))
        self._line.write(request)
        reply = self._reply(request)
        if reply[1] == command:
            return reply[2], reply[3], reply[4]
        if reply[1] == CHECK_SUM_ERROR:
            raise GarbledReply(
                f"The {self._name} received a telegram with a wrong check byte; check the line."
            )
        if reply[1] == REFUSED and command == READ_POSITION:
            raise DeviceFault(
                f"The {self._name} cannot measure: its gap to the tape is too large, its position is"
                " implausible, or it moves faster than 5 m/s; look at head and tape."
            )
        raise DeviceFault(
            f"The {self._name} refuses command {command:02X}h (error {reply[1]:02X}h);"
            " is it the configured model?"
        )

    def _reply(self, request: bytes) -> bytes:
        """One whole telegram of this head and nothing else."""
        deadline_s = time.monotonic() + self._timeout_s
        received = b""
        while not self._is_reply(received, request[1]):
            more = self._line.read_some(deadline_s)
            if not more:
                raise self._garbled(received) if received else self._silent()
            received += more
            self._line.refuse_echo(request, received)
            if len(received) > _LONG_LENGTH:
                raise self._garbled(received)
        return received

    def _is_reply(self, received: bytes, command: int) -> bool:
        if len(received) < _SHORT_LENGTH or with_check_byte(received[:-1]) != received:
            return False
        if len(received) == _LONG_LENGTH:
            return received[0] == self._address and received[1] == command
        errors = (CHECK_SUM_ERROR, REFUSED, ILLEGAL_VALUE)
        mine = received[0] in (self._address, self._address | _SHORT)
        return len(received) == _SHORT_LENGTH and mine and received[1] in errors

    def _silent(self) -> LinkLost:
        return LinkLost(
            f"The {self._name} does not answer on {self._line.address}; check cable, power and address."
        )

    def _garbled(self, received: bytes) -> GarbledReply:
        return GarbledReply(
            f"The {self._name} answered {received[:16].hex(' ')}, which is not a reply it may give;"
            " check the line."
        )


def with_check_byte(telegram: bytes) -> bytes:
    """A telegram and the exclusive or of its bytes."""
    check = 0
    for byte in telegram:
        check ^= byte
    return telegram + bytes((check,))


def in_words(data: bytes) -> str:
    """The meaning of sent or received bytes, for readers of a wire log."""
    if len(data) not in (_SHORT_LENGTH, _LONG_LENGTH) or with_check_byte(data[:-1]) != data:
        return f"bytes {data.hex(' ')}"
    command = _COMMANDS.get(data[1], f"command {data[1]:02X}h")
    head = f"head {data[0] & ~_SHORT}"
    if len(data) == _SHORT_LENGTH:
        return f"{head}: {command}"
    return f"{head}: {command} = {int.from_bytes(data[2:5], 'little', signed=True)}"


DRIVER = ScaleDriver(SikoSettings, SikoHead, in_words)
