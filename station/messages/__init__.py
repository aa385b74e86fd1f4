"""Texts for people: display names, explanations and reasons, in one file for each language (`en.json`);
sentences with parameters in another (`en-phrases.json`), and texts of the diagnosis report in a third
(`en-report.json`).

The page reads the same files; REST returns a code with parameters beside the English sentence.
"""

from __future__ import annotations

from station.messages.filling import capital, phrase_text, reason_text, report_text
from station.messages.locales import (
    local_date,
    local_number,
    local_time,
    measured,
    number_in_words,
    unit_name,
)
from station.messages.texts import (
    LANGUAGES,
    Group,
    Language,
    both,
    certificate_text,
    dependence_name,
    display_name,
    effect_name,
    explanation,
    labels_in_words,
    parameter_name,
    part_name,
    reasons,
)

__all__ = [
    "LANGUAGES",
    "Group",
    "Language",
    "both",
    "capital",
    "certificate_text",
    "dependence_name",
    "display_name",
    "effect_name",
    "explanation",
    "labels_in_words",
    "local_date",
    "local_number",
    "local_time",
    "measured",
    "number_in_words",
    "parameter_name",
    "part_name",
    "phrase_text",
    "reason_text",
    "reasons",
    "report_text",
    "unit_name",
]
