"""The agreement of a run's readings so far, for display only; the run's own identification is decisive."""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass, field, replace

from station.errors import InputRefused
from station.five_bar import Robot
from station.identification import identify, residuals_of
from station.records import Reading, Residual, from_readings

log = logging.getLogger(__name__)

FEWEST = 8
"""Number of readings from which the fit has information on each."""
SHARE = 0.1
"""Maximum share of the worker's time for fits."""


@dataclass
class SoFar:
    """Readings since the zeros of the drives were last written, or the mechanism was last remounted."""

    robot: Robot
    _readings: list[Reading] = field(default_factory=list)
    _next_s: float = 0.0

    def renew(self) -> None:
        """Zeros or mounting have changed: earlier readings have no information on the next ones."""
        self._readings.clear()

    def add(self, reading: Reading) -> tuple[Residual, ...]:
        """Residuals of all readings including this one; none while there are too few, or it is too early."""
        # positions of different sequences are no repeats: plan `paper` visits them at other angles
        self._readings.append(replace(reading, position=f"{reading.position} {reading.sequence}"))
        began_s = time.monotonic()
        if len(self._readings) < FEWEST or began_s < self._next_s:
            return ()
        try:
            return residuals_of(identify(self.robot, from_readings(self._readings)), self._readings)
        except InputRefused:
            return ()
        except Exception:  # a display must not end a run
            log.exception("The residuals so far cannot be computed")
            return ()
        finally:
            now_s = time.monotonic()
            self._next_s = now_s + (now_s - began_s) / SHARE
