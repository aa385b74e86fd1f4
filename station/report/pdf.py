"""A report as PDF on A4 pages: its texts and tables, without the charts."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import reportlab
from reportlab.lib.colors import HexColor
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import Flowable, Paragraph, SimpleDocTemplate, Spacer
from reportlab.platypus import Table as Grid

from station.report.page import Page, Table

Style = list[tuple[str, tuple[int, int], tuple[int, int], *tuple[Any, ...]]]
"""A ReportLab style."""
_MARGIN = 16 * mm
_QUIET, _LINE = HexColor("#555555"), HexColor("#bbbbbb")
_TEXT = ParagraphStyle("text", fontName="Vera", fontSize=8.5, leading=12, spaceAfter=4)
_CELL = ParagraphStyle("cell", parent=_TEXT, fontSize=7.5, leading=9.5, spaceAfter=0)
_HEAD = ParagraphStyle("head", parent=_CELL, fontName="VeraBd")
_CAPTION = ParagraphStyle("caption", parent=_CELL, textColor=_QUIET, spaceBefore=4, spaceAfter=2)
_H1 = ParagraphStyle("h1", parent=_TEXT, fontName="VeraBd", fontSize=14, leading=18)
_H2 = ParagraphStyle("h2", parent=_H1, fontSize=10.5, leading=14, spaceBefore=8)


def pdf_of(page: Page) -> bytes:
    """The PDF; the same bytes for the same page."""
    folder = Path(reportlab.__file__).parent / "fonts"
    for name, file in (("Vera", "Vera.ttf"), ("VeraBd", "VeraBd.ttf")):
        pdfmetrics.registerFont(TTFont(name, folder / file))
    out = BytesIO()
    document = SimpleDocTemplate(
        out,
        pagesize=A4,
        leftMargin=_MARGIN,
        rightMargin=_MARGIN,
        topMargin=_MARGIN,
        bottomMargin=_MARGIN,
        title=page.title,
        invariant=True,
    )
    document.build(list(_flowables(page)), onFirstPage=_number, onLaterPages=_number)
    return out.getvalue()


def _flowables(page: Page) -> Iterator[Flowable]:
    yield Paragraph(escape(page.title), _H1)
    yield Paragraph(escape(page.lead), _TEXT)
    for section in page.sections:
        yield Paragraph(escape(section.heading), _H2)
        for text in section.text:
            yield Paragraph(escape(text), _TEXT)
        for table in section.tables:
            if table.caption:
                yield Paragraph(escape(table.caption), _CAPTION)
            yield _grid(table)
            yield Spacer(0, 2 * mm)


def _grid(table: Table) -> Grid:
    rows = [[Paragraph(escape(name), _HEAD) for name in table.columns]]
    rows += [[Paragraph(escape(str(cell)), _CELL) for cell in row] for row in table.rows]
    style: Style = [
        ("LINEBELOW", (0, 0), (-1, -1), 0.4, _LINE),
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
        ("LEFTPADDING", (0, 0), (-1, -1), 2),
        ("RIGHTPADDING", (0, 0), (-1, -1), 4),
        ("TOPPADDING", (0, 0), (-1, -1), 1.5),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 1.5),
    ]
    width = A4[0] - 2 * _MARGIN
    return Grid(rows, colWidths=[width / len(table.columns)] * len(table.columns), style=style, repeatRows=1)


def _number(canvas: Canvas, document: SimpleDocTemplate) -> None:
    canvas.setFont("Vera", 7)
    canvas.drawRightString(A4[0] - _MARGIN, _MARGIN / 2, str(document.page))
