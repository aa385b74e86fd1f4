"""Unnamed errors by the motion before a reading or the attitude of the guide: often mistaken for backlash."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from station.diagnosis.explanations.family import Family, Hidden, sizes
from station.diagnosis.explanations.rough_families import DEG
from station.diagnosis.explanations.situation import Action, Situation
from station.diagnosis.explanations.structured_families import unnamed
from station.records import Real

WAYS_DEG = (1.5, 4.0, 10.0, 25.0)
SPEEDS = (2.0,)
"""Speed at which half of the static friction effect remains, over that of the faster joint."""
TRAVEL_MM = 100.0


def motion_families(s: Situation) -> tuple[Family, ...]:
    """Families for the readings of `s`: of both joints, the reading and the guide."""
    return (
        *(_by_way(i) for i in (1, 2)),
        *(_loose(i) for i in (1, 2)),
        _lagging(),
        _guide(s),
    )


def _by_way(joint: int) -> Family:
    """A joint that stops short of its target, as a function of the distance or speed of its motion."""
    hidden = tuple({"way_deg": w, "fades": f} for w in WAYS_DEG for f in (0.0, 1.0))
    hidden += tuple({"speed": s} for s in SPEEDS)

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        way, sense = np.abs(s.way), s.approach[:, joint - 1]
        longest = way.max(axis=1)
        # axes that arrive together move at speeds proportional to their distances
        speed = np.divide(way[:, joint - 1], longest, out=np.ones(len(way)), where=longest > 0.0)

        def lost(h: Hidden) -> Real:
            if "speed" in h:
                return np.asarray(1.0 / (1.0 + h["speed"] * speed))
            fading = np.exp(-way[:, joint - 1] / (h["way_deg"] * DEG))
            return np.asarray(1.0 - fading if h["fades"] else fading)

        return [Action(f"joint{joint}", np.stack([sense * lost(h) for h in hidden])[:, :, None])]

    return unnamed("rest by way", "approach", 0.3, sizes(3e-4 * DEG, 0.1 * DEG), hidden, actions)


def _loose(joint: int) -> Family:
    """Clearance in the passive bearing of a chain, taken up by the sense of its own joint or of the other."""
    hidden = ({"of": 0.0}, {"of": 1.0})

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        own = [int(h["of"]) for h in hidden]
        sense = s.approach[:, [joint - 1, 2 - joint]].T[own]
        return [Action(f"l{joint}", sense[:, :, None])]

    return unnamed("passive play", "approach", 0.2, sizes(0.001, 0.3), hidden, actions)


def _lagging() -> Family:
    """A reading that lags, or a base that still oscillates: as a function of the motion just before."""
    hidden = tuple({"form": float(k)} for k in range(6))

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        drawn, way = s.drawn / TRAVEL_MM, s.way
        shapes = (drawn, np.abs(drawn), way[:, 0], way[:, 1], np.abs(way[:, 0]), np.abs(way[:, 1]))
        return [Action("reading", np.stack([shapes[int(h["form"])] for h in hidden])[:, :, None])]

    return unnamed("lagging reading", "approach", 0.5, sizes(0.001, 0.5), hidden, actions)


def _guide(s: Situation) -> Family:
    """Slider and guide bend under their weight: as a function of their attitude and extension."""
    low, span = float(s.travel.min()), float(np.ptp(s.travel)) or 1.0
    hidden = tuple({"across": a, "drawn": d} for a in (1.0, 2.0, 4.0) for d in (0.0, 1.0, 2.0, 3.0))

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        across, drawn = s.direction[:, 0], (s.travel - low) / span
        shapes = [across ** int(h["across"]) * np.sign(drawn) * np.abs(drawn) ** h["drawn"] for h in hidden]
        return [Action("reading", np.stack(shapes)[:, :, None])]

    return unnamed("guide by attitude", "reading", 0.8, sizes(0.003, 2.0), hidden, actions)
