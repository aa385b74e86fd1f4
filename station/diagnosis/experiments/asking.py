"""Planned readings (position, side of approach, time), and what an explanation predicts for them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.experiments.in_question import Hypothesis
from station.diagnosis.experiments.outcomes import Outcome
from station.diagnosis.explanations import ExplanationSet, specified_as, tangent
from station.five_bar import FiveBar, inverse
from station.plans import SIDES
from station.records import Complex, Measurements, Real

RUN_UP = np.radians(1.0)
GRID = (8, 5)
STOPS = GRID[0] * GRID[1]
START_SD_MM = 10.0
"""Of the start of a scale about which nothing is known."""


def over_workspace(found: ExplanationSet) -> tuple[Complex, Real]:
    """Positions (K,) over the workspace and sides (K, 2): each approached otherwise than the one before."""
    places = found.mechanism.robot.workspace_grid(*GRID)
    sides = np.array([SIDES[k % len(SIDES)] for k in range(len(places))], dtype=float)
    return places, sides


def asked(found: ExplanationSet, places: Complex, sides: Real, stops: int) -> Measurements:
    """Readings at positions (K,) from sides (K, 2), in the middle of an experiment of this many stops."""
    learned = found.mechanism.measurements
    robot, p = found.mechanism.robot, found.shown.x[: found.shown.size]
    theta = inverse(robot.geometry, places) - p[:2]
    before = theta - RUN_UP * sides
    count = len(places)
    pace_s = float(np.median(np.diff(learned.t_s)))
    readings = Measurements(
        ids=tuple(range(count)),
        t_s=np.full(count, learned.t_s.max() + 0.5 * stops * pace_s),
        theta=theta,
        approach=np.asarray(sides, dtype=np.int8),
        distance=np.zeros(count),
        position=np.arange(count),
        mount=np.full(count, learned.mount[-1]),
        samples=np.full(count, learned.samples[-1]),
        mounts=learned.mounts,
        temperature_c=_all(learned.temperature_c, count),
        payload_kg=_all(learned.payload_kg, count),
    )
    return placed(FiveBar(robot, readings), p, before)


def placed(mechanism: FiveBar, p: Real, before: Real) -> Measurements:
    """The readings of a mechanism with their nominal distances, where the arm comes from `before` (K, 2)."""
    m = mechanism.measurements
    here, there = (mechanism.observe(p, angles).value for angles in (m.theta, before))
    return replace(m, distance=here, came_from=np.column_stack([before, there]))


def _all(column: Real | None, count: int) -> Real | None:
    """The conditions at the end of the readings."""
    return None if column is None else np.full(count, column[-1])


def outcome(
    found: ExplanationSet, mechanism: FiveBar, hypothesis: Hypothesis, more: Real | None = None
) -> Outcome:
    """What one explanation predicts for the readings of a mechanism.

    :param more: (N, X) what other conditions add to the derivatives by its unknowns; None: nothing
    """
    settled = hypothesis.settled
    residual, jacobian = tangent(mechanism, found.weighing.reference, settled)
    mean = mechanism.measured - residual
    if more is not None:
        mean, jacobian = mean + more @ settled.x, jacobian + more
    sd = specified_as(found.weighing, mechanism) * settled.level
    return Outcome.linear(mean, jacobian, settled.covariance, sd)
