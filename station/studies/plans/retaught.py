"""Taught positions after a collision and a second calibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.five_bar import inverse
from station.identification import identify, zero_difference
from station.records import TaughtPosition
from station.run_kinds import Change, translated
from station.settings import DEFAULT_JOINTS
from station.studies.drawn import drawn, robot_of
from station.studies.plans.references import measured
from station.studies.population import PlainMachine

POINTS = 50
"""A machine."""


@dataclass(frozen=True)
class Retaught:
    """One position, mm."""

    off_mm: float
    """From where it was taught, by the machine's own geometry."""
    u95_mm: float
    marked: bool


def retaught(item: tuple[float, int]) -> list[Retaught]:
    """Full run, applied; positions taught; collision; full run with memory, applied: (tolerance, seed)."""
    robot = robot_of(item[0])
    machine, rng = drawn(robot, item[1])
    before = identify(robot, measured(machine, "full", rng))
    struck = machine.struck(rng)
    after = identify(robot, measured(struck, "full", rng), before.lasting)
    same = after.gate is not None and after.gate.used
    shift, covariance = zero_difference(before, after, same_mounting=same)
    # both were applied: what is left of each zero is its error
    shift = shift - before.dtheta + after.dtheta
    (left, right), (low, high) = robot.workspace_x, robot.workspace_y
    places = rng.uniform(left, right, POINTS) + 1j * rng.uniform(low, high, POINTS)
    theta = inverse(robot.geometry, places)
    taught = [
        TaughtPosition(position=f"P{k}", theta1_deg=float(a), theta2_deg=float(b))
        for k, (a, b) in enumerate(np.degrees(theta))
    ]
    found = translated(Change(robot, shift, covariance), taught, DEFAULT_JOINTS)
    new = np.radians([[one.theta1_deg, one.theta2_deg] for one in found])
    then = PlainMachine(robot, machine.truth).stand(theta - before.dtheta)
    now = PlainMachine(robot, struck.truth).stand(new - after.dtheta)
    return [
        Retaught(float(off), one.u95_mm or float("nan"), not one.within_limits)
        for off, one in zip(np.abs(then - now), found, strict=True)
    ]
