"""One machine: diagnosed, and every experiment of an open question carried out on the emulated machine.

The emulated machine computes readings and angles from its own physics.  The explanations are then weighed
again by these, as the diagnosis predicted that it would do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.diagnosis.experiments import (
    COARSE,
    REFERENCE_SD,
    STOPS,
    SURE,
    Hypothesis,
    Outcome,
    asked,
    at_second_mount,
    decides,
    hypotheses,
    joint_reference,
    motion,
    probabilities,
    reference_rows,
    second_mount,
)
from station.diagnosis.explanations import ExplanationSet
from station.diagnosis.weighed_loop import weighed
from station.errors import InputRefused
from station.five_bar import FiveBar, Robot
from station.records import Real
from station.studies.confusion import KINDS
from station.studies.confusion.machines import draw
from station.studies.engine import Engine
from station.studies.simulation import SimulatedMachine

RUN_UP = np.radians(1.0)
JOINTS = (1, 2)


@dataclass(frozen=True)
class Tried:
    """One experiment on one machine."""

    kind: str
    predicted: float
    """Probability to decide, as the diagnosis states it."""
    decided: bool
    """Whether one explanation had a probability of 0.95 afterwards."""


def experiments(machines: int, seed: int, engine: Engine) -> list[tuple[Tried, ...]]:
    """One machine of each kind in turn, so many in all; empty where there was nothing to decide."""
    return engine.each(tried, [seed * 1_000_003 + k for k in range(machines)], "Machines")


def tried(seed: int) -> tuple[Tried, ...]:
    """All experiments on the machine of this seed."""
    robot = Robot.default()
    drawn = draw(robot, KINDS[seed % len(KINDS)], seed)
    try:
        found = weighed(robot, drawn.sequence, drawn.fresh).found
    except InputRefused:
        return ()
    some = hypotheses(found)
    if len(some) < 2 or some[0].probability >= SURE:
        return ()
    prior = [one.probability for one in some]

    def one(kind: str, outcomes: Sequence[Outcome], read: Real) -> Tried:
        after = probabilities(outcomes, prior, read[:, None])
        return Tried(kind, decides(outcomes, prior), bool(after.max() >= SURE))

    machine = drawn.machine
    out = [one("motion", *_moved(machine, found, some))]
    out += [
        one(
            f"reference of joint {joint}",
            joint_reference(found, some, joint),
            _seen(machine, found, joint, seed),
        )
        for joint in JOINTS
    ]
    # last: the mechanism stays there
    out.append(one("second mount", second_mount(found, some), _mounted(machine, found, some)))
    return tuple(out)


def _moved(
    machine: SimulatedMachine, found: ExplanationSet, some: Sequence[Hypothesis]
) -> tuple[Sequence[Outcome], Real]:
    chosen = motion(found, some, STOPS, COARSE)
    mechanism = found.mechanism.of(asked(found, chosen.places, chosen.sides, STOPS))
    return chosen.outcomes, _read(machine, mechanism, found.shown.x[: found.shown.size])


def _mounted(machine: SimulatedMachine, found: ExplanationSet, some: Sequence[Hypothesis]) -> Real:
    mechanism, known = at_second_mount(found, some)
    x, y = mechanism.robot.mounts[mechanism.measurements.mounts[-1]]
    machine.remount((x, y))
    return _read(machine, mechanism, known[0].settled.x[: known[0].settled.size])


def _read(machine: SimulatedMachine, mechanism: FiveBar, p: Real) -> Real:
    """(N,) mm, readings at the planned angles; the servos rest some pulses beside them."""
    planned = mechanism.measurements
    taken = machine.arrive(planned.theta, np.asarray(planned.came_from)[:, :2])
    beside = mechanism.observe(p, taken.theta).value - mechanism.observe(p, planned.theta).value
    return np.asarray(taken.distance - beside)


def _seen(machine: SimulatedMachine, found: ExplanationSet, joint: int, seed: int) -> Real:
    """(N,) rad, angles of a proximal link with a level, less feedback."""
    m = found.weighing.mechanism.measurements.take(reference_rows(found, joint))
    arms = machine.arms(m.theta, m.theta - RUN_UP * m.approach)
    noise = np.random.default_rng([seed, joint]).normal(0.0, REFERENCE_SD, len(m))
    return np.asarray(arms[:, joint - 1] + noise)
