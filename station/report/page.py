"""A report as one HTML page that needs nothing but itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from station.report.templates import environment


@dataclass(frozen=True)
class Table:
    """Cells are texts or numbers already rounded for people."""

    columns: Sequence[str]
    rows: Sequence[Sequence[object]]
    caption: str = ""


@dataclass(frozen=True)
class Chart:
    """An SVG of `station.report.svg` and what it shows."""

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

    def to_html(self) -> str:
        return environment().get_template("page.html.j2").render(page=self)
