"""The experiments of an open question carried out on a machine, and whether they decided as predicted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from station.diagnosis.experiments.asking import RUN_UP, STOPS, asked
from station.diagnosis.experiments.by_hand import (
    REFERENCE_SD,
    at_second_mount,
    joint_reference,
    reference_rows,
    second_mount,
)
from station.diagnosis.experiments.further_motion import motion
from station.diagnosis.experiments.in_question import Hypothesis, hypotheses
from station.diagnosis.experiments.outcomes import SURE, Outcome, decides, probabilities
from station.diagnosis.experiments.rating import COARSE
from station.diagnosis.explanations import ExplanationSet
from station.five_bar import FiveBar
from station.records import Measurements, Real

JOINTS = (1, 2)


class Machine(Protocol):
    """A machine on which experiments can be carried out."""

    def arrive(self, theta: Real, before: Real) -> Measurements:
        """One reading at each of drive angles theta (K, 2), rad, each reached from `before` (K, 2)."""
        ...

    def arms(self, theta: Real, before: Real) -> Real:
        """(K, 2) rad, true angles of the proximal links less the feedback of the drives, reached likewise."""
        ...

    def remount(self, c_mm: tuple[float, float]) -> None:
        """Mount the mechanism there."""
        ...


@dataclass(frozen=True)
class Trial:
    """One experiment that was carried out."""

    kind: str
    predicted: float
    """Probability to decide, as the diagnosis states it."""
    decided: bool
    """Whether one explanation had a probability of 0.95 afterwards."""


def trials(found: ExplanationSet, machine: Machine, rng: np.random.Generator) -> tuple[Trial, ...]:
    """Each experiment by itself, on the machine as it stands; empty if there is nothing to decide.

    :param rng: draws the errors of the level
    """
    some = hypotheses(found)
    if len(some) < 2 or some[0].probability >= SURE:
        return ()
    prior = [one.probability for one in some]

    def carried_out(kind: str, outcomes: Sequence[Outcome], read: Real) -> Trial:
        after = probabilities(outcomes, prior, read[:, None])
        return Trial(kind, decides(outcomes, prior), bool(after.max() >= SURE))

    out = [carried_out("motion", *_moved(machine, found, some))]
    for joint in JOINTS:
        seen = _seen(machine, found, joint, rng)
        out.append(carried_out(f"reference of joint {joint}", joint_reference(found, some, joint), seen))
    # last: the mechanism stays there
    out.append(carried_out("second mount", second_mount(found, some), _mounted(machine, found, some)))
    return tuple(out)


def _moved(
    machine: Machine, found: ExplanationSet, some: Sequence[Hypothesis]
) -> tuple[Sequence[Outcome], Real]:
    chosen = motion(found, some, STOPS, COARSE)
    mechanism = found.mechanism.of(asked(found, chosen.places, chosen.sides, STOPS))
    return chosen.outcomes, _read(machine, mechanism, found.shown.x[: found.shown.size])


def _mounted(machine: Machine, found: ExplanationSet, some: Sequence[Hypothesis]) -> Real:
    mechanism, known = at_second_mount(found, some)
    x, y = mechanism.robot.mounts[mechanism.measurements.mounts[-1]]
    machine.remount((x, y))
    return _read(machine, mechanism, known[0].settled.x[: known[0].settled.size])


def _read(machine: Machine, mechanism: FiveBar, p: Real) -> Real:
    """(N,) mm, readings at the planned angles; the servos rest some pulses beside them."""
    planned = mechanism.measurements
    taken = machine.arrive(planned.theta, np.asarray(planned.came_from)[:, :2])
    beside = mechanism.observe(p, taken.theta).value - mechanism.observe(p, planned.theta).value
    return np.asarray(taken.distance - beside)


def _seen(machine: Machine, found: ExplanationSet, joint: int, rng: np.random.Generator) -> Real:
    """(N,) rad, angles of a proximal link with a level, less feedback."""
    m = found.weighing.mechanism.measurements.take(reference_rows(found, joint))
    arms = machine.arms(m.theta, m.theta - RUN_UP * m.approach)
    return np.asarray(arms[:, joint - 1] + rng.normal(0.0, REFERENCE_SD, len(m)))
