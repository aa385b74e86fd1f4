"""What a run in state `waiting` asks of a person."""

from __future__ import annotations

from datetime import datetime

from station.records.record import Record
from station.records.run import PromptKind


class Prompt(Record):
    """A question with a time limit."""

    id: str
    """To be given with the answer."""
    text: str
    kind: PromptKind
    """Whether a number is asked for."""
    unit: str | None
    expires_at: datetime
    """Without an answer the run ends then."""
