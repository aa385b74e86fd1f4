"""A client of the station's REST interface, for a MES: `Station`, typed and with retries."""

from __future__ import annotations

from fivebar_client.errors import Refused, StationError, Unexpected, Unreachable
from fivebar_client.models import (
    Calibration,
    CalibrationBody,
    CalibrationSummary,
    Event,
    Problem,
    ReadingAnswer,
    StationView,
    Stopped,
)
from fivebar_client.station import ENDED, Station

__version__ = "0.2.0"

__all__ = [
    "ENDED",
    "Calibration",
    "CalibrationBody",
    "CalibrationSummary",
    "Event",
    "Problem",
    "ReadingAnswer",
    "Refused",
    "Station",
    "StationError",
    "StationView",
    "Stopped",
    "Unexpected",
    "Unreachable",
]
