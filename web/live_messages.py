"""The messages of the live feed, by type.  The page's types come from here, through the OpenAPI file."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from station.records import (
    CalibrationSummary,
    DeviceView,
    Interlock,
    MachineView,
    Record,
    ResidualOfReading,
    RetractView,
    RunBrief,
    RunReading,
    SequenceView,
    StationView,
)


class _Message(Record):
    number: int
    """Of the last event that this message or an earlier one tells."""
    at: datetime
    build: str
    """Changes with the page's files; the page then loads itself again."""


class SnapshotMessage(_Message):
    """Everything, to begin with and after a gap."""

    type: Literal["snapshot"]
    data: StationView


class BeatMessage(_Message):
    """Each second: the service lives."""

    type: Literal["beat"]
    data: None = None


class RunMessage(_Message):
    """The run under way, after any change of state or step."""

    type: Literal["run"]
    data: RunBrief


class SequenceMessage(_Message):
    """A measurement sequence begins."""

    type: Literal["walk"]
    data: SequenceView


class ReadingMessage(_Message):
    """A reading was stored."""

    type: Literal["reading"]
    data: RunReading


class ResidualsMessage(_Message):
    """An identification has judged the readings."""

    type: Literal["residuals"]
    data: tuple[ResidualOfReading, ...]


class MachineMessage(_Message):
    """Where the arm stands; null while it is not known."""

    type: Literal["machine"]
    data: MachineView | None


class DeviceMessage(_Message):
    """The state of a device has changed."""

    type: Literal["device"]
    data: DeviceView


class InterlockMessage(_Message):
    """An interlock has changed."""

    type: Literal["interlock"]
    data: tuple[Interlock, ...]


class RetractMessage(_Message):
    """Whether the arm has to be brought back has changed, or how far."""

    type: Literal["retract"]
    data: RetractView


class EndedMessage(_Message):
    """The run has ended."""

    type: Literal["ended"]
    data: CalibrationSummary


LiveMessage = Annotated[
    SnapshotMessage
    | BeatMessage
    | RunMessage
    | SequenceMessage
    | ReadingMessage
    | ResidualsMessage
    | MachineMessage
    | DeviceMessage
    | InterlockMessage
    | RetractMessage
    | EndedMessage,
    Field(discriminator="type"),
]
LIVE_MESSAGE: TypeAdapter[LiveMessage] = TypeAdapter(LiveMessage)
