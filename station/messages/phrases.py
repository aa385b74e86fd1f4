"""Templates of sentences that are composed of parts."""

from __future__ import annotations

from station.messages.filling import filled
from station.messages.texts import Language, templates


def phrase_text(code: str, params: dict[str, float | int | str], language: Language = "en") -> str:
    """A sentence or a part of one.  :raises KeyError: the code is unknown, or a parameter is missing."""
    return filled(templates(language, "phrases")[code], params, language)
