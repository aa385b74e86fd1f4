"""Explanations with probabilities instead of one winner (method.md section 4, docs/decisions/0013).

`explain` weighs the base model, every effect alone, natural pairs and sets of up to three effects, and errors
without a name against each other; everything reported is that of the whole set.
"""

from __future__ import annotations

from station.diagnosis.explanations.explanation_set import Explanation, ExplanationSet, Held, explain
from station.diagnosis.explanations.mixture import Mixture, PositionError
from station.diagnosis.explanations.validation import Validation
from station.diagnosis.explanations.verdict import Decision, Finding, Verdict

__all__ = [
    "Decision",
    "Explanation",
    "ExplanationSet",
    "Finding",
    "Held",
    "Mixture",
    "PositionError",
    "Validation",
    "Verdict",
    "explain",
]
