"""Experiments that decide between explanations, each rated by the probability that it will.

`hypotheses` are the explanations in question; `outcomes` says what an experiment would read under each of
them, and how often one of them would then be left; `motion` chooses the stops of further motion; the other
modules are one kind of experiment each; `rating` puts them in order.
"""

from __future__ import annotations

from station.diagnosis.experiments.hypotheses import Hypothesis, hypotheses
from station.diagnosis.experiments.motion import INSET_MM, PLACES, Motion, motion
from station.diagnosis.experiments.outcomes import Outcome, decides
from station.diagnosis.experiments.rating import Rated, rated

__all__ = [
    "INSET_MM",
    "PLACES",
    "Hypothesis",
    "Motion",
    "Outcome",
    "Rated",
    "decides",
    "hypotheses",
    "motion",
    "rated",
]
