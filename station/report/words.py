"""The few words of a chart and a page of their own, for whoever draws them in another language."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Words:
    """As a language says it."""

    language: str = "en"
    decimal: str = "."
    contents: str = "Contents"
    against: str = "{y} against {x}"
    negative: str = "negative"
    positive: str = "positive; largest disc {size}"

    def number(self, text: str) -> str:
        """A number that is a text already."""
        return text.replace(".", self.decimal)

    def numbers(self, *texts: str) -> str:
        """Several, with what is no decimal sign between them."""
        return ("; " if self.decimal == "," else ", ").join(map(self.number, texts))


ENGLISH = Words()
