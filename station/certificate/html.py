"""The certificate as one self-contained HTML page that prints on one A4 sheet."""

from __future__ import annotations

import hashlib

from station.certificate.facts import CertificateFacts
from station.certificate.map_drawing import COLOURS, drawing_of, significant
from station.certificate.sheet import Sheet
from station.messages import local_number
from station.report import environment

_OPEN, _CLOSE = '<script type="application/json" id="certificate">', "</script>"
_END = "</body>"


def html_page(sheet: Sheet, facts: CertificateFacts) -> str:
    """The page without the document."""
    from station.certificate.qr import modules  # imported here, as for PDF: it is a part of that library

    drawing = drawing_of(facts.error_map) if facts.error_map else None
    side, dark = modules(facts.robot_serial)
    ends = [drawing.edges_mm[0], drawing.edges_mm[-1]] if drawing else []
    return (
        environment("station.certificate")
        .get_template("certificate.html.j2")
        .render(
            sheet=sheet,
            serial=facts.robot_serial,
            drawing=drawing,
            colours=COLOURS,
            ends=[local_number(end, significant(end), sheet.language) for end in ends],
            qr_side=side,
            qr_dark=dark,
        )
    )


def html_sha256(bare: str) -> str:
    """Hash of a page without the document."""
    return hashlib.sha256(bare.encode()).hexdigest()


def with_document(bare: str, document: str) -> str:
    """The page with the document at its end, where no browser executes or shows it."""
    before, _, after = bare.rpartition(_END)
    return f"{before}{_OPEN}{document.replace('</', '<' + chr(92) + '/')}{_CLOSE}{_END}{after}"


def split_document(page: str) -> tuple[str, str] | None:
    """The page without the document, and the document; None if there is none."""
    before, opened, rest = page.rpartition(_OPEN)
    document, closed, after = rest.partition(_CLOSE)
    if not (opened and closed):
        return None
    return before + after, document
