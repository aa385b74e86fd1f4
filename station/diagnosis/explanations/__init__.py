"""Explanations with probabilities instead of one winner (method.md section 4, docs/decisions/0013).

`explain` weighs the base model, every effect alone, natural pairs, sets of up to three effects, and unnamed
errors against each other. Every reported figure is that of the whole set.
"""

from __future__ import annotations

from station.diagnosis.explanations.evidence import Choice
from station.diagnosis.explanations.explanation_set import (
    Explanation,
    ExplanationSet,
    Held,
    explain,
    specified_as,
)
from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.kept_set import KeptError, KeptExplanation, NotInCatalogue, restored
from station.diagnosis.explanations.mixture import Mixture, PositionError, root_of
from station.diagnosis.explanations.settle import Settled
from station.diagnosis.explanations.situation import TARGETS, Around, Situation, at_readings
from station.diagnosis.explanations.stepwise import Step, steps
from station.diagnosis.explanations.validation import Validation, tangent, together
from station.diagnosis.explanations.verdict import Decision, Finding, Verdict

__all__ = [
    "TARGETS",
    "Around",
    "Choice",
    "Decision",
    "Explanation",
    "ExplanationSet",
    "Family",
    "Finding",
    "Held",
    "KeptError",
    "KeptExplanation",
    "Mixture",
    "NotInCatalogue",
    "PositionError",
    "Settled",
    "Situation",
    "Step",
    "Validation",
    "Verdict",
    "at_readings",
    "explain",
    "restored",
    "root_of",
    "specified_as",
    "steps",
    "tangent",
    "together",
]
