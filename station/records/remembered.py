"""Data that a passed run leaves to the robot's next one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime

from station.records.quantity import Quantity
from station.records.record import Record
from station.records.result import FleetPrior, LastingParameters


class MemorySummary(Record):
    """The start values of the robot's next run."""

    from_calibration: int
    at: datetime
    age_days: float
    parameters: tuple[Quantity, ...]


@dataclass(frozen=True, slots=True)
class Remembered:
    """Data that a passed run left to the robot's next one."""

    calibration_id: int
    at: datetime
    memory: LastingParameters
    as_of: datetime | None = None
    """Time at which a run uses it; None is now."""

    @property
    def age_days(self) -> float:
        """Never negative, even if the clock was set back."""
        return max(((self.as_of or datetime.now(UTC)) - self.at).total_seconds(), 0.0) / 86_400.0

    def summary(self) -> MemorySummary:
        """Source, age and content, for people."""
        variances = [row[i] for i, row in enumerate(self.memory.covariance)]
        return MemorySummary(
            from_calibration=self.calibration_id,
            at=self.at,
            age_days=round(self.age_days, 3),
            parameters=tuple(
                Quantity(name, mean, math.sqrt(variance), "mm")
                for name, mean, variance in zip(self.memory.names, self.memory.mean, variances, strict=True)
            ),
        )


Beforehand = Remembered | FleetPrior
"""Knowledge of a robot before a run: from its own runs, otherwise from others of its type."""
