"""Runs on simulated machines, stored as the station stores what it measured."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from station.errors import InputRefused
from station.records import (
    CalibrationRequest,
    CalibrationResult,
    Measurements,
    PlanName,
    Procedure,
    Reading,
    Stop,
)
from station.run_kinds import diagnostic, measured_and_verified
from station.store import Store
from station.studies.confusion import KINDS, of_usual_size
from station.studies.drawn import drawn, robot_of
from station.studies.engine import Engine
from station.studies.population import PlainMachine
from station.studies.walked import Machine, walk

Kind = Literal["calibrate", "diagnose"]
PLANS: dict[Kind, PlanName] = {"calibrate": "full", "diagnose": "diagnostic"}
TOLERANCE_MM = 0.03
AT_ONCE = 1000
"""Runs that are held in memory."""


@dataclass(frozen=True)
class Simulated:
    """One run as it ended."""

    readings: tuple[Reading, ...]
    result: CalibrationResult


@dataclass
class _Plain:
    """A machine without imperfections, with its own noise."""

    machine: PlainMachine
    rng: np.random.Generator

    def run(self, stops: Sequence[Stop], samples: int = 1) -> Measurements:
        return self.machine.read(tuple(stops), self.rng)


def calibration(seed: int) -> Simulated | None:
    """A full calibration of a machine drawn from the tolerances; None where the station refuses."""
    robot = robot_of(TOLERANCE_MM)
    truth = drawn(robot, seed)[0].truth
    machine = _Plain(PlainMachine(robot, truth), np.random.default_rng([seed, 28]))
    # every unknown is identified from the run's own readings
    return _carried_out(measured_and_verified(PLANS["calibrate"], robot, advised=False), machine)


def diagnosis(seed: int) -> Simulated | None:
    """A diagnosis of a machine with an effect, each kind in turn; None where the station refuses."""
    robot = robot_of(TOLERANCE_MM)
    return _carried_out(diagnostic(robot), of_usual_size(robot, KINDS[seed % len(KINDS)], seed))


MAKE: dict[Kind, Callable[[int], Simulated | None]] = {"calibrate": calibration, "diagnose": diagnosis}


def add_simulated(store: Store, kind: Kind, count: int, robots: int, seed: int, engine: Engine) -> int:
    """Store as many runs of so many robots; returns how many the station did not refuse."""
    stored = 0
    for first in range(0, count, AT_ONCE):
        numbers = range(first, min(first + AT_ONCE, count))
        made = engine.each(MAKE[kind], [seed * 1_000_003 + k for k in numbers], f"Runs from {first}")
        for k, one in zip(numbers, made, strict=True):
            if one is not None:
                robot = replace(robot_of(TOLERANCE_MM), serial=f"R{k % robots + 1}")
                store.add_run(_request(robot.serial, kind), robot, one.readings, one.result)
                stored += 1
    return stored


def _carried_out(procedure: Procedure, machine: Machine) -> Simulated | None:
    try:
        walked = walk(procedure, machine)
    except InputRefused:
        return None
    return Simulated(walked.readings, walked.result)


def _request(serial: str, kind: Kind) -> CalibrationRequest:
    return CalibrationRequest(serial, kind, "study", plan=PLANS[kind])
