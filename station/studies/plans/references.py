"""Calibrations with and without a reference: every case on one machine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from station.identification import identify
from station.records import AnyReference, JointAngle, Measurements, MountingError, PlanName, Stop
from station.studies.drawn import Drawn, drawn, robot_of, stops_of
from station.studies.plans.promise import Kept, kept
from station.studies.population import PlainMachine

LEVEL_SD_DEG, MOUNTING_SD_MM = 0.005, 0.02
Array = NDArray[Any]


@dataclass(frozen=True)
class Case:
    """What is measured."""

    plan: PlanName
    level: bool = False
    """Whether the angle of joint 1 is measured with a level."""
    mounting: bool = False
    """Whether the sideways mounting error is measured."""


CASES = {
    "full": Case("full"),
    "full, joint 1 measured to 0.005 degrees": Case("full", level=True),
    "six readings, joint 1 measured": Case("rapid", level=True),
    "full, rMx measured to 0.02 mm": Case("full", mounting=True),
    "full, both": Case("full", level=True, mounting=True),
    "two mounts": Case("two_mounts"),
}


def calibrated(item: tuple[float, int]) -> dict[str, Kept]:
    """Every case on one machine: (tolerance, seed)."""
    robot = robot_of(item[0])
    machine, rng = drawn(robot, item[1])
    level, mounting = references_of(machine, rng)
    readings = {plan: measured(machine, plan, rng) for plan in ("full", "rapid", "two_mounts")}
    out = {}
    for name, case in CASES.items():
        given: list[AnyReference] = [*([level] if case.level else []), *([mounting] if case.mounting else [])]
        out[name] = kept(machine, identify(robot.informed(given), readings[case.plan]), rng)
    return out


def references_of(
    machine: Drawn, rng: np.random.Generator, joint: Literal[1, 2] = 1
) -> tuple[JointAngle, MountingError]:
    """A level on a joint and a gauge of the mounting, as uncertain as they say."""
    seen_deg = float(np.degrees(machine.truth[joint - 1]) + rng.normal(0.0, LEVEL_SD_DEG))
    value_mm = float(machine.truth[10] + rng.normal(0.0, MOUNTING_SD_MM))
    return (
        JointAngle(joint=joint, at_deg=0.0, reads_deg=seen_deg, sd_deg=LEVEL_SD_DEG),
        MountingError(kind="drm_x", value_mm=value_mm, sd_mm=MOUNTING_SD_MM),
    )


def measured(machine: Drawn, plan: PlanName, rng: np.random.Generator) -> Measurements:
    """The readings of a plan; of `two_mounts` those from both mounting points."""
    stops = stops_of(plan, machine.robot.tolerances.link_mm)
    first = PlainMachine(machine.robot, machine.truth).read(stops, rng)
    return with_second_mount(machine, first, stops, rng) if plan == "two_mounts" else first


def with_second_mount(
    machine: Drawn, first: Measurements, stops: tuple[Stop, ...], rng: np.random.Generator
) -> Measurements:
    """Readings, and those at stops from the second mounting point, with a mounting error of its own."""
    robot = machine.robot
    label, c = robot.second_mount
    truth = machine.truth.copy()
    truth[10:] = rng.normal(robot.drm, robot.drm_sd)
    aside = PlainMachine(robot, truth, complex(*c) - complex(*robot.c))
    return joined(first, aside.read(stops, rng), label)


def joined(first: Measurements, second: Measurements, label: str = "") -> Measurements:
    """One after the other; the second ones with the mechanism at mounting point `label`."""
    mounts = tuple(dict.fromkeys((*first.mounts, label)))

    def both(of: Callable[[Measurements], Array]) -> Array:
        return np.concatenate([of(first), of(second)])

    return Measurements(
        ids=tuple(range(1, len(first) + len(second) + 1)),
        t_s=np.concatenate([first.t_s, second.t_s + first.t_s[-1]]),
        theta=both(lambda m: m.theta),
        approach=both(lambda m: m.approach),
        distance=both(lambda m: m.distance),
        position=both(lambda m: m.position),
        mount=np.concatenate([first.mount, np.full(len(second), mounts.index(label))]),
        samples=both(lambda m: m.samples),
        mounts=mounts,
    )
