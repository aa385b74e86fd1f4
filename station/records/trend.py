"""One run, or one effect found by it, as a point of a trend."""

from __future__ import annotations

from datetime import datetime

from station.records.record import Record
from station.records.result import Outcome, Verdict
from station.records.run import State


class TrendPoint(Record):
    """Result and end of a finished run."""

    id: int
    uid: str
    robot_serial: str
    kind: str
    plan: str
    state: State
    verdict: Verdict | None = None
    outcome: Outcome | None = None
    reason_code: str | None = None
    ended_at: datetime | None = None
    dtheta1_deg: float | None = None
    dtheta1_sd_deg: float | None = None
    dtheta2_deg: float | None = None
    dtheta2_sd_deg: float | None = None
    position_error_mm: float | None = None
    """95 % bound of the largest position error, for runs that fresh readings verified; null for others."""
    software: str | None = None
    """Software version of the measurement; null if not recorded."""


class EffectPoint(Record):
    """The size of one effect found by a finished run: the first of its parameters."""

    run: int
    effect: str
    joint: int | None = None
    part: str | None = None
    parameter: str
    unit: str
    value: float
    sd: float | None = None
