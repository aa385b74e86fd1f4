"""What advice predicts and what happens when it is followed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.five_bar import FiveBar
from station.identification import Identification, advice_of, bounds_mm, identify
from station.records import Advice, Measurements
from station.studies.drawn import Drawn, drawn, robot_of, stops_of
from station.studies.plans.references import joined, measured, references_of, with_second_mount


@dataclass(frozen=True)
class Followed:
    """One piece of advice; bounds on the largest position error, mm."""

    kind: str
    predicted_mm: float
    happened_mm: float
    """Bound before less bound after."""
    largest_before_mm: float
    largest_after_mm: float


def followed(item: tuple[float, int]) -> list[Followed]:
    """A full run, and each advice that it gives, followed: (tolerance, seed)."""
    machine, rng = drawn(robot_of(item[0]), item[1])
    readings = measured(machine, "full", rng)
    before = identify(machine.robot, readings)
    bound = bounds_mm(before)[0]
    out = []
    for advice in advice_of(before):
        after = _after(advice, machine, readings, rng)
        out.append(
            Followed(
                kind=advice.kind,
                predicted_mm=advice.gain_mm,
                happened_mm=bound - bounds_mm(after)[0],
                largest_before_mm=machine.largest_errors_mm(before)[0],
                largest_after_mm=machine.largest_errors_mm(after)[0],
            )
        )
    return out


def _after(
    advice: Advice, machine: Drawn, readings: Measurements, rng: np.random.Generator
) -> Identification[FiveBar]:
    if advice.kind == "repeat":
        return identify(machine.robot, joined(readings, measured(machine, "full", rng)))
    if advice.kind == "second_mount":
        stops = stops_of("full", machine.robot.tolerances.link_mm)
        return identify(machine.robot, with_second_mount(machine, readings, stops, rng))
    level, mounting = references_of(machine, rng, 2 if advice.joint == 2 else 1)
    reference = level if advice.kind == "joint_angle" else mounting
    return identify(machine.robot.informed([reference]), readings)
