"""Why a run ended with its outcome: a code with parameters, and the sentence in English."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from station.messages import Language, reason_text
from station.records.phrases import Phrase
from station.records.record import Record

ReasonValue = float | int | str | Phrase


class Reason(Record):
    """`code` is one of the reasons in `station.messages`; other languages use the same parameters."""

    code: str
    params: Annotated[dict[str, ReasonValue], Field(default_factory=dict)]

    @property
    def text(self) -> str:
        """The sentence in English."""
        return reason_in(self.code, self.params, "en")


def reason_in(code: str, params: Mapping[str, ReasonValue], language: Language) -> str:
    """The sentence in a language.  :raises KeyError: the code is unknown, or a parameter is missing."""
    plain = {name: p.text(language) if isinstance(p, Phrase) else p for name, p in params.items()}
    return reason_text(code, plain, language)


def because(code: str, **params: ReasonValue) -> Reason:
    """A reason; its sentence is made at once, so that a missing parameter is detected at its origin."""
    reason_in(code, params, "en")
    return Reason(code=code, params=params)
