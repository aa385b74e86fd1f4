"""How the readings of a run agree while it goes on: to be looked at; the run's own identification judges."""

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
"""Readings from which the fit says something of each."""
SHARE = 0.1
"""Of the worker's time that fits may take."""


@dataclass
class SoFar:
    """Readings since the zeros of the drives were last written, or the mechanism was mounted once more."""

    robot: Robot
    _readings: list[Reading] = field(default_factory=list)
    _next_s: float = 0.0

    def renew(self) -> None:
        """Zeros or mounting are others: earlier readings say nothing of the next ones."""
        self._readings.clear()

    def add(self, reading: Reading) -> tuple[Residual, ...]:
        """Residuals of all readings with this one; nothing while there are too few, or it is too early."""
        # positions of different sequences are no repeats: plan `paper` visits them at other angles
        self._readings.append(replace(reading, position=f"{reading.position} {reading.sequence}"))
        began_s = time.monotonic()
        if len(self._readings) < FEWEST or began_s < self._next_s:
            return ()
        try:
            return residuals_of(identify(self.robot, from_readings(self._readings)), self._readings)
        except InputRefused:
            return ()
        except Exception:  # what is only looked at must not end a run
            log.exception("The residuals so far cannot be computed")
            return ()
        finally:
            now_s = time.monotonic()
            self._next_s = now_s + (now_s - began_s) / SHARE
