"""Experiments that decide between explanations, each rated by the probability that it decides.

`in_question` holds the explanations to decide between. `outcomes` predicts the readings of an experiment
under each explanation, and how often one explanation would then remain. `further_motion` chooses the stops of
additional motion. `by_hand` has those with another mount or instrument, `other_conditions` those that repeat
the positions with a payload, warm, or with another start of the scale. `rating` sorts all of them.
"""

from __future__ import annotations

from station.diagnosis.experiments.asking import STOPS, asked
from station.diagnosis.experiments.by_hand import (
    REFERENCE_SD,
    at_second_mount,
    joint_reference,
    reference_rows,
    second_mount,
)
from station.diagnosis.experiments.further_motion import INSET_MM, PLACES, Motion, motion
from station.diagnosis.experiments.in_question import Hypothesis, hypotheses
from station.diagnosis.experiments.outcomes import SURE, Outcome, decides, probabilities
from station.diagnosis.experiments.rating import COARSE, Rated, rated

__all__ = [
    "COARSE",
    "INSET_MM",
    "PLACES",
    "REFERENCE_SD",
    "STOPS",
    "SURE",
    "Hypothesis",
    "Motion",
    "Outcome",
    "Rated",
    "asked",
    "at_second_mount",
    "decides",
    "hypotheses",
    "joint_reference",
    "motion",
    "probabilities",
    "rated",
    "reference_rows",
    "second_mount",
]
