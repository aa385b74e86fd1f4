"""Details of one device for maintenance."""

from __future__ import annotations

from pydantic import Field

from station.records.live import DeviceView


class DeviceDetail(DeviceView):
    """A device with its own information, and the quality of its line."""

    identity: str = Field(description="as it answered when it was connected; empty when it says nothing")
    heard_s: float | None = Field(description="since it answered last, s; null before the first answer")
    errors: int = Field(description="calls to it that failed since the station started")
    round_trip_ms: float | None = Field(description="of the last reply on its line; both drives share one")
    requests: int = Field(description="sent on its line since the station started")
    replies: int = Field(description="that came on its line; XON at the opening of a line has none")
