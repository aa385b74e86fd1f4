"""One request on a wire with its answer, in plain words."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from station.records.record import Record


class WireExchange(Record):
    """A request to one device, and its answer."""

    at_s: float = Field(description="since the run began")
    device: Literal["scale", "drive 1", "drive 2", "line"] = Field(
        description="`line`: an event of the line itself, or a frame that names no known drive"
    )
    action: Literal["read", "write", "other", "broken", "refused"]
    subject: str = Field(description="what was read or written, for instance `position`; may be empty")
    answer: str = Field(description="what came; empty when nothing did")
    angle_deg: float | None = Field(default=None, description="the answer as a joint angle, where it is one")
    took_ms: float | None = Field(description="to the first byte; null when nothing came")
    beside: bool = Field(description="not by the run itself: a stop, a watchdog's feeder")
