"""Experiments that decide between explanations, each rated by the probability that it decides.

`in_question` holds the explanations to decide between. `outcomes` predicts the readings of an experiment
under each explanation, and how often one explanation would then remain. `further_motion` chooses the stops of
additional motion. `by_hand` has those with another mount or instrument, `other_conditions` those that repeat
the positions with a payload, warm, or with another start of the scale. `rating` sorts all of them; `trial`
carries them out on a machine.
"""

from __future__ import annotations

from station.diagnosis.experiments.further_motion import INSET_MM, PLACES, Motion, motion
from station.diagnosis.experiments.in_question import Hypothesis, hypotheses
from station.diagnosis.experiments.outcomes import Outcome, decides
from station.diagnosis.experiments.rating import Rated, rated
from station.diagnosis.experiments.trial import Trial, trials

__all__ = [
    "INSET_MM",
    "PLACES",
    "Hypothesis",
    "Motion",
    "Outcome",
    "Rated",
    "Trial",
    "decides",
    "hypotheses",
    "motion",
    "rated",
    "trials",
]
