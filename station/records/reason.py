"""Why a run ended as it did: a code with parameters, and the sentence in English."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from station.messages import Language, reason_text
from station.records.phrases import Phrase
from station.records.record import Record

ReasonValue = float | int | str | Phrase


class Reason(Record):
    """`code` is one of the reasons in `station.messages`; other languages say it from the same parameters."""

    code: str
    params: Annotated[dict[str, ReasonValue], Field(default_factory=dict)]

    @property
    def text(self) -> str:
        """In English."""
        return reason_in(self.code, self.params, "en")


def reason_in(code: str, params: Mapping[str, ReasonValue], language: Language) -> str:
    """The sentence in a language.  :raises KeyError: an unknown code, or a parameter that is missing."""
    plain = {name: p.text(language) if isinstance(p, Phrase) else p for name, p in params.items()}
    return reason_text(code, plain, language)


def because(code: str, **params: ReasonValue) -> Reason:
    """A reason; its sentence is made at once, so that a missing parameter is found where it is missing."""
    reason_in(code, params, "en")
    return Reason(code=code, params=params)
