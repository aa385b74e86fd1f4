"""The whole study: every table and figure, accuracy, coverage and choice of places, as one JSON object."""

from __future__ import annotations

from typing import Any

import numpy as np

from station import __version__
from station.five_bar import Robot
from station.studies.engine import Engine, digest
from station.studies.reproduce import printed
from station.studies.reproduce.accuracy import accuracy
from station.studies.reproduce.bound import DEFINITION, bounds
from station.studies.reproduce.coverage import coverage_of, coverage_summary, positions_of, positions_summary
from station.studies.reproduce.errata import errata
from station.studies.reproduce.figures import fig5, fig8
from station.studies.reproduce.tables import NOISES, Trials, fig9, fig12, tables
from station.studies.reproduce.trial import PAPER, PAPER_FEEDBACK, Conditions, Outcome, by_ours, by_paper
from station.studies.simulation import Servo

SAMPLES = (1, 4, 16)
MACHINES_PER_SEED = 5
"""The coverage study draws five machines for every seed of the tables: 1,000 for 200."""


def run_study(seeds: int, engine: Engine) -> dict[str, Any]:
    """What `station reproduce --json` writes."""
    robot = Robot.default()
    kinds = [*_kinds("exact"), *_kinds("whole pulses", *SAMPLES), *_kinds("continuous")]
    jobs = [(conditions, seed) for conditions in kinds for seed in range(seeds)]
    trials = _by_variant(kinds, engine.each(calibrate, jobs, "Calibrating"), seeds)
    limits = dict(zip(kinds, engine.each(bounds, kinds, "Bounds"), strict=True))
    machines = range(MACHINES_PER_SEED * seeds)
    covered = engine.each(coverage_of, machines, "Coverage")
    placed = engine.each(positions_of, machines, "Choice of places")
    by_noise = {(c.group, c.servo): trials[c] for c in kinds if c.samples == 1 and c.servo in NOISES}
    at_three = fig8(robot)[0]
    figures = {
        "schema": "station.reproduction/1",
        "version": __version__,
        "seeds": seeds,
        "kappa_1": at_three["kappa_1"],
        "kappa_m": at_three["kappa_m"],
        "f": "lambda - dr_M",
        "paper": {"kappa_1": printed.KAPPA_1, "kappa_m": printed.KAPPA_M, "f": "lambda + dr_M"},
        "noise": {
            "scale": "eq. 34 on every reading of the head; servos rest on the commanded pulse",
            "scale and servo": "eq. 34, and servos rest beside it by eq. 35, on whole pulses",
        },
        **tables(by_noise),
        "fig5": fig5(robot),
        "fig8": fig8(robot),
        "fig9": fig9(by_noise),
        "fig12": fig12(by_noise),
        "errata": errata(robot, _scatter_deg(by_noise)),
        "bound": DEFINITION,
        "accuracy": accuracy(trials, limits),
        "coverage": coverage_summary(covered),
        "positions": positions_summary(placed),
    }
    return {**figures, "digest": digest(figures)}


def _kinds(servo: Servo, *samples: int) -> list[Conditions]:
    return [Conditions(group, servo, n) for n in samples or (1,) for group in printed.GROUPS]


def _scatter_deg(trials: Trials) -> dict[str, float]:
    """Of the published method's dtheta1 in group 1, by noise."""
    return {
        noise: float(np.std([outcome.dtheta_deg[0] for outcome in trials[1, servo][PAPER]]))
        for servo, noise in NOISES.items()
    }


def calibrate(job: tuple[Conditions, int]) -> dict[str, Outcome]:
    """One machine by every variant that its conditions call for."""
    conditions, seed = job
    out: dict[str, Outcome] = {}
    if conditions.samples == 1 and conditions.servo in NOISES:
        out[PAPER] = by_paper(conditions, seed, feedback=False)
        if conditions.servo != "exact":
            out[PAPER_FEEDBACK] = by_paper(conditions, seed, feedback=True)
    return out | by_ours(conditions, seed)


def _by_variant(
    kinds: list[Conditions], outcomes: list[dict[str, Outcome]], seeds: int
) -> dict[Conditions, dict[str, list[Outcome]]]:
    grouped = {}
    for k, conditions in enumerate(kinds):
        runs = outcomes[k * seeds : (k + 1) * seeds]
        grouped[conditions] = {variant: [run[variant] for run in runs] for variant in runs[0]}
    return grouped
