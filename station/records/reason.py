"""Why a run ended as it did: a code with parameters, and the sentence in English."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from station.messages import reason_text
from station.records.record import Record

ReasonValue = float | int | str


class Reason(Record):
    """`code` is one of the reasons in `station.messages`; other languages say it from the same parameters."""

    code: str
    params: Annotated[dict[str, ReasonValue], Field(default_factory=dict)]

    @property
    def text(self) -> str:
        """In English."""
        return reason_text(self.code, self.params)


def because(code: str, **params: ReasonValue) -> Reason:
    """A reason; its sentence is made at once, so that a missing parameter is found where it is missing."""
    reason_text(code, params)
    return Reason(code=code, params=params)
