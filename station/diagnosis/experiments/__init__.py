"""Experiments that decide between explanations, each rated by the probability that it will.

`in_question` holds the explanations to decide between; `outcomes` says what an experiment would read under
each of them, and how often one of them would then be left; `further_motion` chooses the stops of more
motion; `by_hand` has what a person has to do; `rating` puts all in order.
"""

from __future__ import annotations

from station.diagnosis.experiments.further_motion import INSET_MM, PLACES, Motion, motion
from station.diagnosis.experiments.in_question import Hypothesis, hypotheses
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
