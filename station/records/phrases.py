"""A sentence by its code, with parameters that may be sentences or parts of sentences themselves."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from station.messages import Language, both, capital, phrase_text
from station.records.record import Record

FULL_STOPS = (".", "。")


class Phrase(Record):
    """`code` is a template in `station.messages`; every language uses the same parameters."""

    code: str
    params: Annotated[dict[str, PhraseValue], Field(default_factory=dict)]
    """Numbers, names of columns and keys, other phrases, or several of these, which are joined by "and"."""

    def text(self, language: Language = "en") -> str:
        """With a capital if it is a whole sentence, which has a full stop."""
        text = self._part(language)
        return capital(text) if text.endswith(FULL_STOPS) else text

    def _part(self, language: Language) -> str:
        values = {name: _said(value, language) for name, value in self.params.items()}
        return phrase_text(self.code, values, language)


PhraseValue = float | int | str | Phrase | tuple[str | Phrase, ...]


def phrase(code: str, **params: PhraseValue) -> Phrase:
    """The sentence is made at once, so that a missing parameter is detected at its origin."""
    made = Phrase(code=code, params=params)
    made.text()
    return made


def _said(value: PhraseValue, language: Language) -> float | int | str:
    if isinstance(value, tuple):
        return both([str(_said(one, language)) for one in value], language)
    return value._part(language) if isinstance(value, Phrase) else value
