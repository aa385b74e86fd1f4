"""The messages of the live feed, by type. The page's types are made from them, through the OpenAPI file."""

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
    """Number of the last event in this message or an earlier one."""
    at: datetime
    build: str
    """Changes with the page's files; the page then reloads itself."""


class SnapshotMessage(_Message):
    """The complete state, at the beginning and after a gap."""

    type: Literal["snapshot"]
    data: StationView


class BeatMessage(_Message):
    """Sent each second: the service is running."""

    type: Literal["beat"]
    data: None = None


class RunMessage(_Message):
    """The active run, after any change of state or step."""

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
    """Residuals of the readings, after an identification."""

    type: Literal["residuals"]
    data: tuple[ResidualOfReading, ...]


class MachineMessage(_Message):
    """Position of the arm; null while it is unknown."""

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
    """A change of the distance of the arm outside its workspace, or of whether it has to be brought back."""

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
