"""Motion that tells look-alikes apart: readings where the models that explain a walk disagree most.

Each look-alike is fitted in place of what was found, and both predict the reading at every place of the
workspace, approached from every side, later than the walk.  Chosen are the stops at which the predictions
differ most beyond what noise and the uncertainty of both models could make of it.  What this cannot
separate needs another experiment (a payload, a second mount, a gauge), which the effect itself names.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from station.diagnosis.report import Findings
from station.diagnosis.search import ALIAS
from station.fitting import NotConvergedError
from station.five_bar import INSET_MM, FiveBar, Robot, inverse
from station.model import Fit, Model, fit
from station.plans import SIDES
from station.records import Complex, Measurements, Real, Stop

COUNTS = (40, 80, 160, 240)
"""Stops; time effects need time to part, so that a longer walk may do what a shorter one cannot."""
PLACES = (17, 9)
RUN_UP = np.radians(1.0)
WORTH = 2.0 * ALIAS
"""Chi-square to be expected between two models for a walk to be worth its time; `ALIAS` tells them apart."""


@dataclass(frozen=True)
class Experiment:
    """Stops in measuring order, and what they are for."""

    stops: tuple[Stop, ...]
    apart: tuple[str, ...]
    """Labels of the look-alikes that the readings should tell from what was found, or confirm instead."""


def experiment(findings: Findings) -> Experiment | None:
    """The shortest motion that separates all it can; None where there is no set or none is worth it.

    Nor is there one for effects that are not the cause, nor for a machine that is not the station's to move.
    """
    robot = findings.diagnosis.robot
    if not isinstance(robot, Robot) or not findings.decision.passed:
        return None
    rivals = _rivals(findings)
    best: Experiment | None = None
    for count in COUNTS if rivals else ():
        planned = _planned(robot, findings.diagnosis.last, rivals, count)
        if best is None or len(planned.apart) > len(best.apart):
            best = planned
        if len(best.apart) == len(rivals):
            break
    return best if best is not None and best.apart else None


def _planned(robot: Robot, last: Fit, rivals: dict[str, Fit], count: int) -> Experiment:
    """The best so many stops, chosen one after another."""
    places, sides = _candidates(robot)
    asked = _asked(robot, last, places, sides, count)
    found = _Prediction.by(last, asked)
    disputes = {label: _Dispute.between(found, _Prediction.by(r, asked)) for label, r in rivals.items()}
    chosen: list[int] = []
    for _ in range(count):
        # for the dispute that one more reading brings furthest, as long as any is open
        still = [d for d in disputes.values() if d.expected < WORTH] or list(disputes.values())
        best = int(np.argmax(max(still, key=lambda d: float(d.gain.max())).gain))
        chosen.append(best)
        disputes = {label: d.after(best) for label, d in disputes.items()}
    apart = tuple(label for label, d in disputes.items() if d.expected >= WORTH)
    return Experiment(_stops(robot, last, places, sides, _nearest_first(places, chosen)), apart)


def _rivals(findings: Findings) -> dict[str, Fit]:
    """The last model with each look-alike in place of what was found."""
    d = findings.diagnosis
    fits: dict[str, Fit] = {}
    for k, finding in enumerate(d.trace.findings):
        for alias in finding.aliases:
            terms = tuple(alias if i == k else term for i, term in enumerate(d.last.model.terms))
            try:
                rival = fit(replace(d.last.model, terms=terms), d.base.prior, d.last.row_sd)
            except NotConvergedError:
                continue
            fits[alias.effect.label] = rival
    return fits


def _candidates(robot: Robot) -> tuple[Complex, Real]:
    """(K,) places of the workspace and (K, 2) senses of approach there."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + INSET_MM, x1 - INSET_MM, PLACES[0])
    y = np.linspace(y0 + INSET_MM, y1 - INSET_MM, PLACES[1])
    grid = (x[None, :] + 1j * y[:, None]).ravel()
    return np.repeat(grid, len(SIDES)), np.tile(np.array(SIDES, dtype=float), (len(grid), 1))


def _asked(robot: Robot, last: Fit, places: Complex, sides: Real, stops: int) -> Measurements:
    """Readings as they would be taken there, each after a run-up, in the middle of the experiment."""
    learned = last.model.mechanism.measurements
    theta = inverse(robot.geometry, places) - last.x[:2]
    before = theta - RUN_UP * sides
    count = len(places)  # of candidates
    pace_s = float(np.median(np.diff(learned.t_s)))
    asked = Measurements(
        ids=tuple(range(count)),
        t_s=np.full(count, learned.t_s[-1] + 0.5 * stops * pace_s),
        theta=theta,
        approach=sides.astype(np.int8),
        distance=np.zeros(count),
        position=np.arange(count),
        mount=np.full(count, learned.mount[-1]),
        samples=np.full(count, learned.samples[-1]),
        mounts=learned.mounts,
        temperature_c=_all(learned.temperature_c, count),
        payload_kg=_all(learned.payload_kg, count),
    )
    mechanism, base = FiveBar(robot, asked), last.x[: last.model.base_size]
    here, there = (mechanism.observe(base, angles).value for angles in (theta, before))
    return replace(asked, distance=here, came_from=np.column_stack([before, there]))


def _all(column: Real | None, count: int) -> Real | None:
    """As at the end of the walk."""
    return None if column is None else np.full(count, column[-1])


@dataclass(frozen=True)
class _Prediction:
    """What a model says of readings not yet taken."""

    value_mm: Real
    covariance: Real
    noise: Real
    """(K,) variance of a reading."""

    @classmethod
    def by(cls, learned: Fit, asked: Measurements) -> Self:
        m = learned.model
        model = Model(m.mechanism.of(asked), m.reference, m.terms)
        at = model.observe(learned.x, model.bases(model.conditions(learned.x[: m.base_size], first=False)))
        root = at.by_parameter @ np.linalg.cholesky(learned.solution.covariance)
        ratio = np.mean(learned.row_sd**2) / np.mean(m.mechanism.row_sd**2)
        return cls(at.value, root @ root.T, model.mechanism.row_sd**2 * ratio)


@dataclass(frozen=True)
class _Dispute:
    """Two models over the candidates, given the stops chosen so far."""

    difference: Real
    """(K,) of their predictions, less what the stops chosen leave no doubt about."""
    covariance: Real
    noise: Real
    expected: float = 0.0
    """Chi-square that the stops chosen promise between the two."""

    @classmethod
    def between(cls, one: _Prediction, other: _Prediction) -> Self:
        return cls(other.value_mm - one.value_mm, one.covariance + other.covariance, one.noise)

    @property
    def gain(self) -> Real:
        """(K,) chi-square that one more reading at each candidate adds."""
        return np.asarray(self.difference**2 / (np.diag(self.covariance) + self.noise))

    def after(self, k: int) -> Self:
        """With candidate k read."""
        variance = self.covariance[k, k] + self.noise[k]
        pull = self.covariance[:, k] / variance
        return replace(
            self,
            difference=self.difference - pull * self.difference[k],
            covariance=self.covariance - np.outer(pull, self.covariance[k]),
            expected=self.expected + float(self.gain[k]),
        )


def _nearest_first(places: Complex, chosen: list[int]) -> list[int]:
    """A way that always goes to the nearest place left, its repeats one after another."""
    left = sorted(chosen)
    way = [left.pop(0)]
    while left:
        way.append(left.pop(int(np.argmin(np.abs(places[left] - places[way[-1]])))))
    return way


def _stops(robot: Robot, last: Fit, places: Complex, sides: Real, way: list[int]) -> tuple[Stop, ...]:
    theta = np.degrees(inverse(robot.geometry, places[way]) - last.x[:2])
    return tuple(
        Stop(
            position=f"S{k // len(SIDES) + 1}",
            target_mm=(float(places[k].real), float(places[k].imag)),
            theta_deg=(float(angles[0]), float(angles[1])),
            approach=(int(sides[k, 0]), int(sides[k, 1])),
        )
        for k, angles in zip(way, theta, strict=True)
    )
