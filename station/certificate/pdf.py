"""The certificate as one A4 page in PDF, with the signed document attached."""

from __future__ import annotations

import hashlib
from io import BytesIO
from pathlib import Path
from xml.sax.saxutils import escape

import reportlab
from pypdf import PdfReader, PdfWriter
from pypdf.errors import PyPdfError
from reportlab.lib.colors import HexColor
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.cidfonts import UnicodeCIDFont
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import Paragraph

from station.certificate.facts import CertificateFacts
from station.certificate.map_drawing import COLOURS, Drawing, drawing_of, significant
from station.certificate.qr import modules
from station.certificate.sheet import Block, Sheet
from station.messages import Language, local_number

ATTACHMENT = "certificate.json"
_WIDTH, _HEIGHT = A4
_MARGIN = 14 * mm
_GAP = 6 * mm
_SIZES = (9.0, 8.4, 7.8, 7.2, 6.6, 6.0)
"""Text sizes; the largest is used with which everything fits on the page."""
_LABEL_SHARE = 0.42
_QR = 20 * mm
_LONG_WORD = 30
"""Number of characters without a blank above which a text is broken anywhere: a hash."""
_INK, _QUIET = HexColor("#111111"), HexColor("#444444")


CHINESE_FONTS = (Path("/usr/share/fonts/truetype/wqy/wqy-microhei.ttc"),)
"""TrueType with Latin and Chinese glyphs, which may be embedded: Debian's `fonts-wqy-microhei`."""


def _fonts(language: Language) -> tuple[str, str]:
    """Fonts for text and heading, embedded; for Chinese without such a font, the reader's own are used."""
    if language == "zh":
        found = next((file for file in CHINESE_FONTS if file.is_file()), None)
        font = TTFont("Chinese", found) if found else UnicodeCIDFont("STSong-Light")  # Adobe-GB1
        pdfmetrics.registerFont(font)
        return font.fontName, font.fontName
    folder = Path(reportlab.__file__).parent / "fonts"
    for name, file in (("Vera", "Vera.ttf"), ("VeraBd", "VeraBd.ttf")):
        pdfmetrics.registerFont(TTFont(name, folder / file))
    return "Vera", "VeraBd"


def pdf_page(sheet: Sheet, facts: CertificateFacts) -> bytes:
    """The PDF without the document."""
    for size in _SIZES:
        out = BytesIO()
        canvas = Canvas(out, pagesize=A4, invariant=True, lang=sheet.language)
        canvas.setTitle(f"{sheet.title} {facts.robot_serial}")
        canvas.setAuthor(facts.made_by.station if facts.made_by else "")
        drawing = drawing_of(facts.error_map) if facts.error_map else None
        if _Layout(canvas, sheet, facts.robot_serial, drawing, size).draw() or size == _SIZES[-1]:
            canvas.showPage()
            canvas.save()
            break
    return out.getvalue()


class _Layout:
    """Draws from the top down; `draw` returns whether everything fitted."""

    def __init__(
        self, canvas: Canvas, sheet: Sheet, serial: str, drawing: Drawing | None, size: float
    ) -> None:
        self.canvas, self.sheet, self.serial, self.drawing, self.size = canvas, sheet, serial, drawing, size
        self.text, self.heading = _fonts(sheet.language)

    def draw(self) -> bool:
        inner = _WIDTH - 2 * _MARGIN
        y = self._head(_HEIGHT - _MARGIN, inner)
        column = (inner - _GAP) / 2
        left, right = _balanced(self.sheet.blocks)
        lowest = min(
            self._blocks(left, _MARGIN, y, column), self._blocks(right, _MARGIN + column + _GAP, y, column)
        )
        if self.drawing is not None:
            lowest = self._maps(self.drawing, lowest - 3 * mm, inner)
        for note in self.sheet.notes:
            lowest = self._paragraph(note, _MARGIN, lowest - 1.5 * mm, inner)
        line = _MARGIN + 4 * mm
        self.canvas.line(_MARGIN, line, _MARGIN + 80 * mm, line)
        self._paragraph(self.sheet.signed_by, _MARGIN, line - 1, 80 * mm)
        return lowest > line + 10 * mm

    def _head(self, y: float, inner: float) -> float:
        self._qr(_MARGIN + inner - _QR, y - _QR)
        below = self._paragraph(self.sheet.title, _MARGIN, y, inner - _QR - _GAP, size=15, heading=True)
        below = self._paragraph(self.serial, _MARGIN, below - 2 * mm, inner - _QR - _GAP, size=11)
        below = min(below, y - _QR) - 2 * mm
        self.canvas.line(_MARGIN, below, _MARGIN + inner, below)
        if self.sheet.emulated:
            below = self._paragraph(self.sheet.emulated, _MARGIN, below - 1 * mm, inner, size=9, heading=True)
        statement = self.sheet.statement
        top = below - 2.5 * mm
        below = self._paragraph(
            f"{statement.label}: {statement.text}", _MARGIN + 2 * mm, top - 1.5 * mm, inner - 4 * mm, size=10
        )
        below -= 2 * mm
        self.canvas.rect(_MARGIN, below, inner, top - below)
        return below - 2 * mm

    def _blocks(self, blocks: tuple[Block, ...], x: float, y: float, width: float) -> float:
        for block in blocks:
            y = self._paragraph(block.title, x, y - 2 * mm, width, size=self.size + 1, heading=True) - 1
            self.canvas.setLineWidth(0.4)
            self.canvas.line(x, y, x + width, y)
            for line in block.lines:
                label = width * _LABEL_SHARE
                below = self._paragraph(line.label, x, y - 1, label - 4, quiet=True)
                y = min(below, self._paragraph(line.text, x + label, y - 1, width - label))
        return y

    def _maps(self, drawing: Drawing, y: float, inner: float) -> float:
        y = self._paragraph(self.sheet.map_scale, _MARGIN, y, inner, size=self.size + 1, heading=True) - 2
        width = (inner - 2 * _GAP) / 3
        height = min(width * drawing.aspect, 38 * mm)
        for index, cells in enumerate(drawing.maps):
            x = _MARGIN + index * (width + _GAP)
            for cell in cells:
                self.canvas.setFillColor(HexColor(cell.colour))
                self.canvas.rect(
                    x + cell.x * width, y - height + cell.y * height, cell.width * width,
                    cell.height * height, stroke=0, fill=1,
                )  # fmt: skip
            self.canvas.setFillColor(HexColor("#ffffff"))
            for fresh_x, fresh_y in drawing.fresh if index else ():
                self.canvas.circle(x + fresh_x * width, y - height + fresh_y * height, 1.6, fill=1)
            self.canvas.rect(x, y - height, width, height)
            self._paragraph(self.sheet.map_titles[index], x, y - height - 1, width)
        return self._scale(drawing, y - height - self.size - 6, inner)

    def _scale(self, drawing: Drawing, y: float, inner: float) -> float:
        low, high = (
            f"{local_number(edge, significant(edge), self.sheet.language)} mm"
            for edge in (drawing.edges_mm[0], drawing.edges_mm[-1])
        )
        width = 50 * mm / len(COLOURS)
        for index, colour in enumerate(COLOURS):
            self.canvas.setFillColor(HexColor(colour))
            self.canvas.rect(_MARGIN + 20 * mm + index * width, y - 7, width, 6, stroke=0, fill=1)
        self._paragraph(low, _MARGIN, y, 20 * mm)
        return self._paragraph(high, _MARGIN + 72 * mm, y, inner - 72 * mm)

    def _qr(self, x: float, y: float) -> None:
        side, dark = modules(self.serial)
        module = _QR / side
        self.canvas.setFillColor(_INK)
        for column, row in dark:
            self.canvas.rect(x + column * module, y + _QR - (row + 1) * module, module, module, 0, 1)

    def _paragraph(
        self, text: str, x: float, y: float, width: float, *,
        size: float | None = None, heading: bool = False, quiet: bool = False,
    ) -> float:  # fmt: skip
        """Draws below y and returns the lower edge."""
        size = size or self.size
        longest = max(text.split(), key=len, default="")
        breaks_anywhere = self.sheet.language == "zh" or len(longest) > _LONG_WORD
        style = ParagraphStyle(
            "line",
            fontName=self.heading if heading else self.text,
            fontSize=size,
            leading=size * 1.28,
            textColor=_QUIET if quiet else _INK,
            wordWrap="CJK" if breaks_anywhere else None,
        )
        paragraph = Paragraph(escape(text), style)
        _, height = paragraph.wrap(width, _HEIGHT)
        paragraph.drawOn(self.canvas, x, y - height)
        return float(y - height)


def _balanced(blocks: tuple[Block, ...]) -> tuple[tuple[Block, ...], tuple[Block, ...]]:
    """Two columns of about the same number of lines, in reading order."""
    sizes = [len(block.lines) + 2 for block in blocks]
    best = min(range(1, len(blocks) + 1), key=lambda k: max(sum(sizes[:k]), sum(sizes[k:])))
    return blocks[:best], blocks[best:]


def content_sha256(pdf: bytes) -> str:
    """Hash of everything that is drawn on the pages."""
    digest = hashlib.sha256()
    for page in PdfReader(BytesIO(pdf)).pages:
        contents = page.get_contents()
        digest.update(contents.get_data() if contents is not None else b"")
        digest.update(b"annotated" if "/Annots" in page else b"\n")
    return digest.hexdigest()


def attached(pdf: bytes) -> list[bytes]:
    """The attached documents.

    :raises ValueError: the file is damaged.
    """
    try:
        return PdfReader(BytesIO(pdf)).attachments.get(ATTACHMENT, [])
    except (PyPdfError, KeyError, OSError) as error:
        raise ValueError(str(error)) from error


def shown_text(pdf: bytes) -> str:
    """All text on the pages."""
    return "".join(page.extract_text() for page in PdfReader(BytesIO(pdf)).pages)


def with_attachment(pdf: bytes, document: bytes) -> bytes:
    """The PDF with the document attached."""
    writer = PdfWriter(clone_from=BytesIO(pdf))
    writer.add_attachment(ATTACHMENT, document)
    out = BytesIO()
    writer.write(out)
    return out.getvalue()
