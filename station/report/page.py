"""A report as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from station.report.templates import environment
from station.report.words import ENGLISH, Words

LONG = 24
"""Length of a cell beyond which it is not a number."""


@dataclass(frozen=True)
class Table:
    """Cells are texts or numbers already rounded for display."""

    columns: Sequence[str]
    rows: Sequence[Sequence[object]]
    caption: str = ""

    @property
    def in_words(self) -> tuple[bool, ...]:
        """Whether a column contains longer text: it is left-aligned, and its lines may break."""
        columns = zip(*self.rows, strict=True) if self.rows else ((),) * len(self.columns)
        return tuple(any(isinstance(c, str) and len(c) > LONG for c in cells) for cells in columns)


@dataclass(frozen=True)
class Chart:
    """An SVG of `station.report.svg` and its description."""

    svg: Markup
    caption: str


@dataclass(frozen=True)
class Section:
    """A heading with paragraphs, then tables, then charts."""

    heading: str
    text: Sequence[str] = ()
    tables: Sequence[Table] = ()
    charts: Sequence[Chart] = ()


@dataclass(frozen=True)
class Page:
    """One report."""

    title: str
    lead: str
    sections: Sequence[Section]
    words: Words = ENGLISH

    def to_html(self) -> str:
        return environment().get_template("page.html.j2").render(page=self)
