"""Motion that distinguishes the explanations of a diagnosis: readings where they differ most.

The most probable explanation and every other one predict the reading at every position of the workspace,
approached from every side, later than the existing readings. The chosen stops are those at which the
predictions differ most compared with noise and the uncertainty of both. Explanations that motion cannot
distinguish need another experiment (a payload, a second mount, a gauge); `experiments` of the document rates
them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.diagnosis.experiments import Hypothesis, Motion, decides, hypotheses, motion
from station.diagnosis.naming import named
from station.diagnosis.report import Findings, WeighedFindings
from station.five_bar import Robot, inverse
from station.records import Real, Stop

COUNTS = (40, 80, 160, 240)
"""Numbers of stops; effects of time need time, so a longer sequence may distinguish more."""
WORTH, ENOUGH = 0.3, 0.9
"""Probability to decide from which a motion is offered, and above which no longer one is planned."""
LEAST = 0.02
"""Minimum probability of an explanation that is worth distinguishing from the first."""


@dataclass(frozen=True)
class Experiment:
    """Stops in measuring order, and their purpose."""

    stops: tuple[Stop, ...]
    apart: tuple[str, ...]
    """Labels of the explanations that the readings should distinguish from the first, or confirm instead."""
    decides: float
    """Probability that one explanation reaches 0.95 afterwards."""


def experiment(findings: Findings) -> Experiment | None:
    """The shortest motion that distinguishes all it can; None without a set, or if no motion is worthwhile.

    It is also None for effects that are not the cause, and for a machine that the station does not move.
    """
    if not isinstance(findings, WeighedFindings):
        return None
    if findings.decision.verdict not in ("explained", "ambiguous"):
        return None
    found, some = findings.found, hypotheses(findings.found, LEAST)
    if len(some) < 2:
        return None
    best: tuple[float, Motion] | None = None
    for count in COUNTS:
        planned = motion(found, some, count)
        sure = decides(planned.outcomes, [one.probability for one in some])
        if best is None or sure > best[0]:
            best = sure, planned
        if sure >= ENOUGH:
            break
    if best is None or best[0] < WORTH:
        return None
    sure, chosen = best
    apart = tuple(dict.fromkeys(_label(some[k]) for k in chosen.apart))
    return Experiment(_stops(found.mechanism.robot, chosen, some[0]), apart, sure)


def _label(one: Hypothesis) -> str:
    parts = [(p, f.depends_on) for f in one.settled.families for p in f.parts]
    return " and ".join(named(part.key, depends_on).label for part, depends_on in parts) or "no effect"


def _stops(robot: Robot, chosen: Motion, first: Hypothesis) -> tuple[Stop, ...]:
    zeros: Real = first.settled.x[:2]
    theta = np.degrees(inverse(robot.geometry, chosen.places) - zeros)
    every = {place: k for k, place in enumerate(dict.fromkeys(chosen.places.tolist()))}
    return tuple(
        Stop(
            position=f"S{every[place] + 1}",
            target_mm=(place.real, place.imag),
            theta_deg=(float(angles[0]), float(angles[1])),
            approach=(int(side[0]), int(side[1])),
        )
        for place, side, angles in zip(chosen.places.tolist(), chosen.sides, theta, strict=True)
    )
