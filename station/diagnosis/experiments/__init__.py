"""Experiments that decide between explanations, each rated by the probability that it decides.

`in_question` holds the explanations to decide between. `outcomes` predicts the readings of an experiment
under each explanation, and how often one explanation would then remain. `further_motion` chooses the stops of
additional motion. `by_hand` lists the experiments that a person has to do. `rating` sorts all of them.
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
