"""A report on paper."""

from __future__ import annotations

from station.report.page import Page


def as_pdf(page: Page) -> bytes:
    """Without the charts."""
    # here, because the library takes a second to load and few ask for it
    from station.report.pdf import pdf_of

    return pdf_of(page)
