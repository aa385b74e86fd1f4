"""A report on paper."""

from __future__ import annotations

from station.report.page import Page


def as_pdf(page: Page) -> bytes:
    """The report without the charts."""
    # imported here, because the library takes a second to load and is rarely needed
    from station.report.pdf import pdf_of

    return pdf_of(page)
