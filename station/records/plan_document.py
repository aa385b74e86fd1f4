"""The document of `station plan --json` (schema station.plan/1)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from station.records.accuracy import PositionError
from station.records.record import Record
from station.records.run import PlanName


class PredictedSd(Record):
    """Standard uncertainty of the position at one point of the workspace."""

    x_mm: float
    y_mm: float
    sd_mm: float


class PlanPrediction(Record):
    """The predicted accuracy of a plan, by specification."""

    zero_offset_sd_deg: tuple[float, float]
    common_sd_deg: float
    """Standard uncertainty of the common mode of both zero offsets."""
    position_error_mm: PositionError
    bound_95_mm: float
    """With 95 % probability no position error is larger, for a machine within the tolerances whose drives get
    the zeros and nothing else.
    """
    duration_s: float | None = None
    """Duration of all stops at the station's speeds, in real time, without the verification."""
    travel_deg: float | None = None
    """Motion of the joint with the longer one, summed over the stops."""
    map: tuple[PredictedSd, ...]


class PlannedStop(Record):
    """One stop, in measuring order."""

    stop: int
    position: str
    x_mm: float
    y_mm: float
    theta1_deg: float
    theta2_deg: float
    approach1: int
    approach2: int


class PlanDocument(Record):
    """A plan for one robot."""

    schema_: Annotated[Literal["station.plan/1"], Field(alias="schema")] = "station.plan/1"
    plan: PlanName
    predicted: PlanPrediction
    stops: tuple[PlannedStop, ...]
