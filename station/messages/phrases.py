"""Templates of sentences that are put together of parts."""

from __future__ import annotations

from station.messages.filling import filled
from station.messages.texts import Language, templates


def phrase_text(code: str, params: dict[str, float | int | str], language: Language = "en") -> str:
    """A sentence or a part of one.  :raises KeyError: an unknown code, or a parameter that it needs."""
    return filled(templates(language, "phrases")[code], params, language)
