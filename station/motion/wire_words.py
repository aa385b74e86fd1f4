"""A wire log in words: time, device, request, answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from drivers.lines import wire_events
from drivers.scales import SCALES
from drivers.servos import SERVOS
from station.records import WireHeader

_LINES = {1: "scale", 2: "servo"}
_SERVO = 2


def in_words(header_text: str, lines: Iterable[str]) -> Iterator[str]:
    """One line for each entry of a log that concerns a wire.

    :raises ValueError: a line is not of a log
    """
    header = WireHeader.model_validate_json(header_text)
    scale = SCALES[str(header.scale["protocol"])].words
    servo = SERVOS[str(header.servo["profile"])].words(str(header.servo["url"]))
    sent: dict[int, Callable[[bytes], str]] = {1: scale, _SERVO: servo.request}
    came: dict[int, Callable[[bytes], str]] = {1: scale, _SERVO: servo.answer}
    for event in wire_events(lines):
        match event.what:
            case "tx":
                said = f"-> {sent[event.line](event.data)}"
            case "rx":
                said = f"<- {came[event.line](event.data)}"
            case "broken":
                said = f"the line broke: {event.data.decode()}"
            case "refused":
                said = f"not opened: {event.data.decode().partition(' ')[2]}"
            case _:
                continue
        beside = "" if event.own else "  (beside the run)"
        yield f"{event.at_s:10.4f} s  {_LINES[event.line]}  {said}{beside}"
