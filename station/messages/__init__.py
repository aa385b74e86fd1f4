"""What people read: display names, explanations and reasons, in one file for each language (`en.json`);
sentences that are put together of parts in another (`en-phrases.json`).

The page reads the same files; what travels over REST is a code with parameters beside the English sentence.
"""

from __future__ import annotations

from station.messages.locales import local_date, local_number, local_time, measured
from station.messages.phrases import phrase_text
from station.messages.texts import (
    LANGUAGES,
    Group,
    Language,
    certificate_text,
    dependence_name,
    display_name,
    effect_name,
    explanation,
    parameter_name,
    part_name,
    reason_text,
    reasons,
)

__all__ = [
    "LANGUAGES",
    "Group",
    "Language",
    "certificate_text",
    "dependence_name",
    "display_name",
    "effect_name",
    "explanation",
    "local_date",
    "local_number",
    "local_time",
    "measured",
    "parameter_name",
    "part_name",
    "phrase_text",
    "reason_text",
    "reasons",
]
