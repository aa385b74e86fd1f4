"""The result of an examination: a tree of sentences, each with a state and a remedy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

Condition = Literal["ok", "note", "trouble"]


@dataclass
class Finding:
    """One sentence, and its parts."""

    text: str
    condition: Condition = "ok"
    """`note`: works, but needs attention; `trouble`: does not work."""
    do: str = ""
    """The action for the reader."""
    parts: list[Finding] = field(default_factory=list)

    def add(self, text: str, condition: Condition = "ok", do: str = "") -> Finding:
        """Add a part; it is returned so that it can have parts."""
        part = Finding(text, condition, do)
        self.parts.append(part)
        return part

    def all(self) -> Iterator[Finding]:
        """This finding and all below it."""
        yield self
        for part in self.parts:
            yield from part.all()

    @property
    def healthy(self) -> bool:
        """Whether nothing in the tree is in trouble."""
        return all(finding.condition != "trouble" for finding in self.all())
