"""A procedure carried out on an emulated machine in virtual time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from station.records import (
    CalibrationResult,
    Measurements,
    MeasurementSequence,
    Procedure,
    Reading,
    Stop,
)
from station.studies.simulation import SAMPLES


class Machine(Protocol):
    """What can be measured."""

    def run(self, stops: Sequence[Stop], samples: int = 1) -> Measurements:
        """One reading at each stop, the mean of so many samples."""


@dataclass(frozen=True)
class Walked:
    """What came of it."""

    result: CalibrationResult
    readings: tuple[Reading, ...]
    machine_s: float
    """Of the readings of the first walk, from the first command on."""


def walk(procedure: Procedure, machine: Machine) -> Walked:
    """Follow a procedure that only measures, to its end."""
    taken: list[Reading] = []
    try:
        step = next(procedure)
        while True:
            assert isinstance(step, MeasurementSequence)
            readings = _measured(machine, step, len(taken))
            taken += readings
            step = procedure.send(readings)
    except StopIteration as end:
        own = [r.t_s for r in taken if r.sequence == 1]
        return Walked(end.value, tuple(taken), max(own, default=0.0))


def _measured(machine: Machine, step: MeasurementSequence, before: int) -> list[Reading]:
    m = machine.run(step.stops, SAMPLES)
    return [
        Reading(
            reading=before + k + 1,
            t_s=float(m.t_s[k]),
            theta_deg=(float(a), float(b)),
            approach=(int(m.approach[k, 0]), int(m.approach[k, 1])),
            scale_mm=float(m.distance[k]),
            position=stop.position,
            sequence=step.number,
            samples_mm=(float(m.distance[k]),) * int(m.samples[k]),
        )
        for k, (stop, (a, b)) in enumerate(zip(step.stops, np.degrees(m.theta), strict=True))
    ]
