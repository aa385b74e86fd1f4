"""What an examination finds: a tree of sentences, each with a state and what to do."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

Condition = Literal["ok", "note", "trouble"]


@dataclass
class Finding:
    """One sentence, and what it consists of."""

    text: str
    condition: Condition = "ok"
    """`note`: works, but should be looked at; `trouble`: does not work."""
    do: str = ""
    """What the reader should do about it."""
    parts: list[Finding] = field(default_factory=list)

    def add(self, text: str, condition: Condition = "ok", do: str = "") -> Finding:
        """A part; returned so that it can have parts."""
        part = Finding(text, condition, do)
        self.parts.append(part)
        return part

    def all(self) -> Iterator[Finding]:
        """This and everything below."""
        yield self
        for part in self.parts:
            yield from part.all()

    @property
    def healthy(self) -> bool:
        """Whether nothing in the tree is in trouble."""
        return all(finding.condition != "trouble" for finding in self.all())
