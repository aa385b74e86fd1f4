"""Unnamed errors of a part that something else drives: another part, or time.

A joint deflects as the other arm turns; frame, links and mechanism move slowly, or slip.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from station.diagnosis.explanations.family import Family, Hidden, Shapes, side_by_side, sizes
from station.diagnosis.explanations.rough_families import DEG, beginnings, stepped, wave
from station.diagnosis.explanations.situation import Action, Situation
from station.diagnosis.explanations.structured_families import of_mechanism, unnamed
from station.records import Real

PARTS = ("L1", "L2", "l1", "l2", "e1x", "e1y", "e2x", "e2y")
SLIPS_SELDOM = 0.03
"""Prior weight of a part that moves once: this is far more frequent for a head or a drive."""


def coupled_families(s: Situation) -> tuple[Family, ...]:
    """Families for the readings of `s`."""
    course = _course(s)
    return (
        *(_by_other_joint(joint) for joint in (1, 2)),
        *(_moving(targets, "frame in time", 0.1, course) for targets in (("e1x", "e1y"), ("e2x", "e2y"))),
        *(_moving((link,), "link in time", 0.2, course) for link in ("L1", "L2", "l1", "l2")),
        _mounting(course),
        *(_slipped(part, beginnings(s)) for part in PARTS),
    )


def _by_other_joint(joint: int) -> Family:
    """The error of a joint as a function of the angle of the other."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"joint{joint}", wave(s.theta[:, 2 - joint], [h["per_turn"] for h in hidden]))]

    hidden = ({"per_turn": 1.0}, {"per_turn": 2.0})
    return unnamed("joint by joint", f"joint{3 - joint}", 0.2, sizes(0.002 * DEG, 0.3 * DEG), hidden, actions)


def _moving(targets: tuple[str, ...], kind: str, weight: float, course: Shapes) -> Family:
    """A part moves steadily, or with increasing or decreasing speed."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return side_by_side(targets, [course(s)[None] for _ in targets])

    return unnamed(kind, "time", weight, sizes(0.002, 0.5), ({},), actions)


def _mounting(course: Shapes) -> Family:
    """The same for the point where the mechanism is mounted."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [of_mechanism(s, course(s))]

    return unnamed("mechanism in time", "time", 0.2, sizes(0.002, 0.5), ({},), actions)


def _slipped(part: str, moments: tuple[Hidden, ...]) -> Family:
    """A link moves once in its clamp, or a bearing in its seat."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(part, stepped(s.t_s, hidden))]

    return unnamed("part slips", "time", SLIPS_SELDOM, sizes(0.002, 5.0), moments, actions)


def _course(s: Situation) -> Shapes:
    """The time of these readings from 0 to 1, and its square."""
    low, span = float(s.t_s.min()), float(np.ptp(s.t_s)) or 1.0

    def shapes(s: Situation) -> Real:
        part = (s.t_s - low) / span
        return np.column_stack([part, part * part])

    return shapes
