"""The same positions again under other conditions, and the readings that each explanation predicts there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from station.diagnosis.experiments.asking import START_SD_MM, STOPS, asked, outcome, over_workspace
from station.diagnosis.experiments.in_question import Hypothesis
from station.diagnosis.experiments.outcomes import Outcome
from station.diagnosis.explanations import ExplanationSet, Family, Situation, at_readings
from station.five_bar import FiveBar
from station.records import Real

KNOWN_SHARE = 0.5
"""Relative standard deviation of the effect of a payload: compliance per kilogram is not known."""
LOADED = frozenset(
    {"platform by load", "mechanism by load", "bearing under load", "frame under load", "link under load"}
)
"""Unnamed errors that grow with the load; the named one is sag."""
WARMER_K, LATER_S = 5.0, 3600.0
SHIFT_MM = 7.3
"""Shift of the scale: no multiple of a usual period of the signal, and small compared with the travel."""
Changed = Callable[[Situation], Situation]


def payload(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    """With a payload that about doubles the sag."""
    mechanism = _repeated(found)
    out = []
    for one in some:
        said, settled = outcome(found, mechanism, one), one.settled
        s = at_readings(mechanism, settled.x[: settled.size], found.weighing.reference, first=False)
        more = np.zeros(len(s))
        for family, choice, amplitudes in zip(
            settled.families, settled.choices, settled.amplitudes, strict=True
        ):
            if _loaded(family):
                more += family.columns(s, choice.member)[0] @ amplitudes
        out.append(replace(said, mean=said.mean + more).beside(KNOWN_SHARE * more))
    return out


def warm_up(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    """An hour later, when the machine is warmer; an unnamed error by time may then have any value of its
    size.
    """

    def warm(s: Situation) -> Situation:
        return replace(s, t_s=s.t_s + LATER_S, rise=None if s.rise is None else s.rise + WARMER_K)

    out = _changed(found, some, warm, lambda family: family.named)
    for k, one in enumerate(some):
        settled, learned = one.settled, found.weighing.frame.situation
        for family, choice, amplitudes in zip(
            settled.families, settled.choices, settled.amplitudes, strict=True
        ):
            if family.depends_on == "time":
                so_far = family.columns(learned, choice.member)[0] @ amplitudes
                out[k] = out[k].beside(np.full(STOPS, float(np.sqrt(np.mean(so_far**2)))))
    return out


def scale_start(found: ExplanationSet, some: Sequence[Hypothesis]) -> list[Outcome]:
    """With the scale shifted along its travel; its start is not known then."""

    def shifted(s: Situation) -> Situation:
        return replace(s, travel=s.travel + SHIFT_MM)

    repeated = _changed(found, some, shifted, lambda family: True)
    return [said.beside(np.full(STOPS, START_SD_MM)) for said in repeated]


def _repeated(found: ExplanationSet) -> FiveBar:
    places, sides = over_workspace(found)
    return found.mechanism.of(asked(found, places, sides, STOPS))


def _changed(
    found: ExplanationSet, some: Sequence[Hypothesis], changed: Changed, by: Callable[[Family], bool]
) -> list[Outcome]:
    """The outcomes with the errors `by` as they are under the changed conditions."""
    mechanism = _repeated(found)
    out = []
    for one in some:
        settled = one.settled
        s = at_readings(mechanism, settled.x[: settled.size], found.weighing.reference, first=False)
        then = changed(s)
        more: Real = np.zeros((len(s), len(settled.x)))
        for family, choice, where in zip(settled.families, settled.choices, settled.parts, strict=True):
            if by(family):
                more[:, where] += family.columns(then, choice.member)[0] - family.columns(s, choice.member)[0]
        out.append(outcome(found, mechanism, one, more))
    return out


def _loaded(family: Family) -> bool:
    return family.kind in LOADED or any(part.effect == "compliance" for part in family.parts)
