"""Robots of one type, one after another: how many readings the next one needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.five_bar import SIZE, Robot
from station.identification import Memory, bounds_mm, fleet_prior, identify
from station.plans import USUAL
from station.records import FleetPrior, LastingParameters, Real
from station.run_kinds import adaptive_run, fit_in_sequence
from station.studies.drawn import Drawn, robot_of, zero_offsets
from station.studies.plans.promise import Kept, kept
from station.studies.plans.references import measured
from station.studies.walked import walk

OWN = 0.2
"""Share of the tolerance by which robots of a type differ; the rest they have in common."""
SIZES = (0, 1, 5, 20)
NEXT_ONES = 4
"""Robots that are measured beside each other after so many."""
WISH = 1.01


@dataclass(frozen=True)
class NextOne:
    """A robot that was never measured, after so many of its type."""

    before: int
    readings: int
    used: bool
    reached: bool
    kept: Kept
    wrong_refused: bool
    """Whether the prior was dropped for a robot that is of another type, though its file says otherwise."""


def taught(item: tuple[float, int]) -> list[NextOne]:
    """A fleet, and the next ones after 0, 1, 5 and 20 of it: (tolerance, seed)."""
    robot, rng = robot_of(item[0]), np.random.default_rng([item[1], 20])
    shared = np.sqrt(1.0 - OWN**2) * item[0] * rng.standard_normal(8)
    left: list[tuple[Robot, LastingParameters]] = []
    out: list[NextOne] = []
    for count in range(max(SIZES) + 1):
        prior = fleet_prior("study", robot, left)
        if count in SIZES:
            out += [_next_one(robot, prior, shared, count, rng, item[1]) for _ in range(NEXT_ONES)]
        known = Memory.of_fleet(prior) if prior else None
        found = identify(robot, measured(_made(robot, shared, rng, item[1]), "full", rng), known)
        left.append((robot, found.lasting.record()))
    return out


def _next_one(
    robot: Robot, prior: FleetPrior | None, shared: Real, count: int, rng: np.random.Generator, seed: int
) -> NextOne:
    machine = _made(robot, shared, rng, seed)
    wish_mm = WISH * bounds_mm(identify(robot, measured(machine, "full", rng)))[0]
    run = walk(adaptive_run(robot, prior, wish_mm, USUAL), machine.machine(1))
    used = run.result.fleet is not None and run.result.fleet.used
    fit = fit_in_sequence(robot, list(run.readings), prior if used else None, 0.0)
    # of another type: nothing in common with these
    other = _made(robot, _other_type(rng, robot), rng, seed)
    wrong = None
    if prior is not None:
        wrong = identify(robot, measured(other, "full", rng), Memory.of_fleet(prior)).gate
    return NextOne(
        before=count,
        readings=len(run.readings),
        used=used,
        reached=bool(run.result.accuracy and run.result.accuracy.reached),
        kept=kept(machine, fit),
        wrong_refused=wrong is not None and not wrong.used,
    )


def _other_type(rng: np.random.Generator, robot: Robot) -> Real:
    """(8,) what robots of a type that is made three times as roughly have in common, mm."""
    return 3.0 * robot.tolerances.link_mm * rng.standard_normal(8)


def _made(robot: Robot, shared: Real, rng: np.random.Generator, seed: int) -> Drawn:
    truth = np.zeros(SIZE)
    truth[:2] = zero_offsets(rng)
    truth[2:10] = shared + OWN * robot.tolerances.link_mm * rng.standard_normal(8)
    truth[10:] = rng.normal(robot.drm, robot.drm_sd)
    return Drawn(robot, truth, int(rng.integers(1 << 20)) + seed)
