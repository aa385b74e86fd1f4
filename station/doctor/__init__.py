"""`station doctor`: examination of all devices at once, without motion."""

from __future__ import annotations

from station.doctor.examination import examine, examine_in_service
from station.doctor.finding import Condition, Finding

__all__ = ["Condition", "Finding", "examine", "examine_in_service"]
