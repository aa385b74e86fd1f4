"""The header of a wire log: the station that it was recorded at."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, JsonValue

from station.records.record import Record


class WireHeader(Record):
    """First line of a wire log, as JSON."""

    version: Literal[1] = 1
    scale: dict[str, JsonValue]
    """`[scale]` of the station file, with every option."""
    servo: dict[str, JsonValue]
    """`[servo]`, likewise."""
    limits: dict[str, JsonValue]
    """`[limits]`, likewise."""
    interlocks: dict[str, JsonValue] = Field(default_factory=dict)
    """`[interlocks]`, likewise."""
    speed: float
    """Speed of the machine over real time."""
