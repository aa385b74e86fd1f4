"""The few fixed words of a chart and a page, replaceable for another language."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Words:
    """The words in one language."""

    language: str = "en"
    decimal: str = "."
    contents: str = "Contents"
    against: str = "{y} against {x}"
    negative: str = "negative"
    positive: str = "positive; largest disc {size}"

    def number(self, text: str) -> str:
        """A number that is already formatted."""
        return text.replace(".", self.decimal)

    def numbers(self, *texts: str) -> str:
        """Several numbers, with a separator that is not a decimal sign."""
        return ("; " if self.decimal == "," else ", ").join(map(self.number, texts))


ENGLISH = Words()
