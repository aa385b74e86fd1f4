"""Charts and pages of reports."""

from __future__ import annotations

from station.report.page import Chart, Page, Section, Table
from station.report.printing import as_pdf
from station.report.svg import Series, bar, line, place_map, scatter, standalone
from station.report.templates import environment
from station.report.words import Words

__all__ = [
    "Chart",
    "Page",
    "Section",
    "Series",
    "Table",
    "Words",
    "as_pdf",
    "bar",
    "environment",
    "line",
    "place_map",
    "scatter",
    "standalone",
]
