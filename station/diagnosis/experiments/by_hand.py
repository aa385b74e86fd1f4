"""Experiments with another instrument or mount, and the readings that each explanation predicts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from station.diagnosis.experiments.asking import START_SD_MM, STOPS, asked, outcome, over_workspace, placed
from station.diagnosis.experiments.in_question import Hypothesis
from station.diagnosis.experiments.outcomes import Outcome
from station.diagnosis.explanations import ExplanationSet, Family, Situation
from station.five_bar import FiveBar
from station.records import Index, Real

MOUNT = "second"
MOUNT_BESIDE_MM = 200.0
ANGLES = 5
REFERENCE_SD = np.radians(0.005)
"""Standard uncertainty of a good level or index."""
GAUGE_PLACES, GAUGE_SD_MM = 10, 2e-3


def second_mount(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    """The mechanism at another point of the base, known as well as the first one."""
    mechanism, known = at_second_mount(found, some)
    return [outcome(found, mechanism, one) for one in known]


def at_second_mount(found: ExplanationSet, some: Sequence[Hypothesis]) -> tuple[FiveBar, list[Hypothesis]]:
    """The planned readings there, and the explanations with the unknown errors of that mounting."""
    learned = found.mechanism
    robot = learned.robot
    mounts = {**robot.mounts, MOUNT: (robot.c[0] + MOUNT_BESIDE_MM, robot.c[1])}
    m = asked(found, *over_workspace(found), STOPS)
    elsewhere = replace(m, mount=np.full(len(m), len(m.mounts)), mounts=(*m.mounts, MOUNT))
    mechanism = FiveBar(replace(robot, mounts=mounts), elsewhere)
    known = [one.of(mechanism, learned) for one in some]
    before = np.asarray(m.came_from)[:, :2]
    p = known[0].settled.x[: known[0].settled.size]
    return mechanism.of(placed(mechanism, p, before)), known


def joint_reference(found: ExplanationSet, some: Sequence[Hypothesis], joint: int) -> list[Outcome]:
    """The angle of one proximal link against the drive's feedback, over the range of the joint."""
    rows = reference_rows(found, joint)
    s = _at_once(found.weighing.frame.situation.take(rows))
    out = []
    for one in some:
        settled = one.settled
        jacobian = np.zeros((len(rows), len(settled.x)))
        jacobian[:, joint - 1] = 1.0
        for family, choice, where in zip(settled.families, settled.choices, settled.parts, strict=True):
            jacobian[:, where] = _on(family, s, choice.member, f"joint{joint}")
        out.append(Outcome.linear(jacobian @ settled.x, jacobian, settled.covariance, REFERENCE_SD))
    return out


def reference_rows(found: ExplanationSet, joint: int) -> Index:
    """Readings at whose angles that joint is seen."""
    return _spread(found.weighing.frame.situation.theta[:, joint - 1], ANGLES)


def gauge(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    """The reading against a known length, over the travel; its start is not known."""
    situation = found.weighing.frame.situation
    s = _at_once(situation.take(_spread(situation.travel, GAUGE_PLACES)))
    out = []
    for one in some:
        settled = one.settled
        jacobian = np.zeros((len(s), len(settled.x)))
        for family, choice, where in zip(settled.families, settled.choices, settled.parts, strict=True):
            if family.depends_on in (None, "reading"):
                jacobian[:, where] = _on(family, s, choice.member, "reading")
        said = Outcome.linear(jacobian @ settled.x, jacobian, settled.covariance, GAUGE_SD_MM)
        out.append(said.beside(np.full(len(s), START_SD_MM)))
    return out


def _at_once(s: Situation) -> Situation:
    """The same time and temperature during the whole experiment."""
    count = len(s)
    rise = None if s.rise is None else np.full(count, s.rise[-1])
    return replace(s, t_s=np.full(count, s.t_s.max()), rise=rise)


def _on(family: Family, s: Situation, member: int, target: str) -> Real:
    """(N, q) contribution of a unit of each amplitude to one target."""
    out: Real = np.zeros((len(s), family.width))
    for action in family.actions(s, family.hidden[member : member + 1]):
        if action.target == target:
            out = out + action.basis[0]
    return out


def _spread(values: Real, count: int) -> Index:
    """Rows at evenly spaced values."""
    order = np.argsort(values, kind="stable")
    return np.asarray(order[np.linspace(0, len(order) - 1, count).astype(int)])
