"""A wire log as exchanges: each request together with its answer and the elapsed time."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator
from typing import Literal

from drivers.lines import XON, ModbusWords, WireEvent, wire_events
from drivers.scales import SCALES
from drivers.servos import SERVOS
from station.records import WireExchange, WireHeader
from station.settings import JointSettings, ServoSettings

_SCALE = 1
_READ, _EXCEPTION = 0x03, 0x80
_WRITES = (0x06, 0x10)
_DEVICES: tuple[Literal["drive 1"], Literal["drive 2"]] = ("drive 1", "drive 2")


def exchanges(header_text: str, lines: Iterable[str]) -> list[WireExchange]:
    """Every request of a log, in order, with the first bytes received before the next request on its line.

    :raises ValueError: a line is not of a log
    """
    # a missing answer is only certain after later requests on the other line
    return sorted(_paired(header_text, lines), key=lambda exchange: exchange.at_s)


def _paired(header_text: str, lines: Iterable[str]) -> Iterator[WireExchange]:
    reader = _Reader(WireHeader.model_validate_json(header_text))
    waiting: dict[int, WireEvent] = {}
    for event in wire_events(lines):
        if event.what == "clock" or event.what == "nothing":
            continue
        asked = waiting.pop(event.line, None)
        if event.what == "rx":
            if asked is not None:
                yield reader.exchange(asked, event)
            continue
        if asked is not None:
            yield reader.exchange(asked, None)
        if event.what == "tx":
            waiting[event.line] = event
        else:
            yield _of_the_line(event)
    for asked in waiting.values():
        yield reader.exchange(asked, None)


def _of_the_line(event: WireEvent) -> WireExchange:
    return WireExchange(
        at_s=event.at_s,
        device="scale" if event.line == _SCALE else "line",
        action="broken" if event.what == "broken" else "refused",
        subject="",
        answer=event.data.decode(),
        took_ms=None,
        beside=not event.own,
    )


class _Reader:
    """Decodes entries with the devices that the log was recorded with."""

    def __init__(self, header: WireHeader) -> None:
        driver = SERVOS[str(header.servo["profile"])]
        self._scale = SCALES[str(header.scale["protocol"])].words
        self._servo: ModbusWords = driver.words(str(header.servo["url"]))
        self._position = driver.position_register
        self._joints: tuple[JointSettings, ...] = ServoSettings.model_validate(header.servo).joint

    def exchange(self, asked: WireEvent, came: WireEvent | None) -> WireExchange:
        took_ms = None if came is None else round((came.at_s - asked.at_s) * 1000, 1)
        if asked.line == _SCALE:
            resumes = asked.data == XON
            return WireExchange(
                at_s=asked.at_s,
                device="scale",
                action="other" if resumes else "read",  # XON has no answer
                subject="resume sending (XON)" if resumes else self._scale(asked.data),
                answer=self._scale(came.data) if came else "",
                took_ms=took_ms,
                beside=not asked.own,
            )
        unit, pdu = self._servo.taken_apart(asked.data)
        function, address = struct.unpack_from(">BH", pdu) if pdu is not None and len(pdu) >= 3 else (0, 0)
        said = self._servo.request(asked.data)  # this also gives the answer its context
        reads, writes = function == _READ, function in _WRITES
        joint = next((j for j, joint in enumerate(self._joints) if joint.unit == unit), None)
        return WireExchange(
            at_s=asked.at_s,
            device="line" if joint is None else _DEVICES[joint],
            action="read" if reads else "write" if writes else "other",
            subject=self._servo.name(address) if reads or writes else said,
            answer=self._servo.answer(came.data) if came else "",
            angle_deg=self._angle(joint, came) if reads and address == self._position else None,
            took_ms=took_ms,
            beside=not asked.own,
        )

    def _angle(self, joint: int | None, came: WireEvent | None) -> float | None:
        """Joint angle from the pulses in an answer with the position of a drive."""
        if joint is None or came is None:
            return None
        _, pdu = self._servo.taken_apart(came.data)
        if pdu is None or len(pdu) != 6 or pdu[0] & _EXCEPTION:
            return None
        (pulses,) = struct.unpack(">i", pdu[2:])
        return round(self._joints[joint].scaling.to_deg(pulses), 4)
