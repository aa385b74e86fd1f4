"""Templates of sentences that are put together of parts."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files

from station.messages.filling import filled
from station.messages.texts import Language


def phrase_text(code: str, params: dict[str, float | int | str], language: Language = "en") -> str:
    """A sentence or a part of one.  :raises KeyError: an unknown code, or a parameter that it needs."""
    return filled(_phrases(language)[code], params, language)


@cache
def _phrases(language: Language) -> dict[str, str]:
    content: dict[str, str] = json.loads(
        files("station.messages").joinpath(f"{language}-phrases.json").read_text(encoding="utf-8")
    )
    return content
