"""The question of a run in state `waiting` to a person."""

from __future__ import annotations

from datetime import datetime

from station.records.record import Record
from station.records.run import PromptKind


class Prompt(Record):
    """A question with a time limit."""

    id: str
    """Identifier to return with the answer."""
    text: str
    kind: PromptKind
    """Whether a number is requested."""
    unit: str | None
    expires_at: datetime
    """Without an answer the run ends at this time."""
