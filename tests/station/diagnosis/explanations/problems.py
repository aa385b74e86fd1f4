"""A small sequence of the emulated machine, and families with one column each."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from station.diagnosis.explanations.cleaning import start
from station.diagnosis.explanations.family import Family, Hidden, Part, nothing
from station.diagnosis.explanations.frame import Frame, frame
from station.diagnosis.explanations.noise_level import NoiseLevel, specified
from station.diagnosis.explanations.situation import Action, Situation
from station.five_bar.mechanism import FiveBar
from station.five_bar.robot_file import Robot
from station.mechanism.conditions import Reference, reference_of
from station.records.measurements import Measurements
from station.records.types import Real
from station.studies.simulation import SimulatedMachine

ROBOT = Robot.default()
TRUTH = np.array([0.02, -0.012, 0.01, -0.02, 0.02, 0.01, 0.01, -0.01, 0.02, -0.02, 1.03, 0.52])


@cache
def measured(seed: int, *effects: tuple[tuple[str, Any], ...]) -> tuple[Measurements, Measurements]:
    """The diagnostic sequence and fresh readings of a machine with these effects."""
    machine = SimulatedMachine(ROBOT, TRUTH, "whole pulses", seed, [dict(e) for e in effects])
    return machine.diagnostic_run(ROBOT, seed)


def effect(**table: Any) -> tuple[tuple[str, Any], ...]:
    """An effect of a rig file as a key."""
    return tuple(sorted(table.items()))


def linearised(seed: int = 1) -> tuple[Frame, NoiseLevel, Reference]:
    """A clean sequence about its fit."""
    mechanism = FiveBar(ROBOT, measured(seed)[0])
    reference = reference_of(mechanism.measurements)
    p, residual = start(mechanism, reference)
    at = frame(mechanism, p, reference, specified(mechanism, residual))
    return at, NoiseLevel(len(at.row_sd), at.parameters_taken), reference


def on_reading(name: str, columns: Real, sizes: Sequence[float], *, signed: bool = False) -> Family:
    """A family of one member that adds columns (K, q) to the reading."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", columns[None])]

    part = Part(name, None, None, tuple(range(columns.shape[1])), nothing)
    return Family(name, (part,), 1.0, np.array(sizes), ({},), actions, signed=signed)
