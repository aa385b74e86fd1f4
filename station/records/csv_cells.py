"""Text in tables that spreadsheets open: no cell may be interpreted as a formula."""

from __future__ import annotations

_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "\uff1d", "\uff0b", "\uff0d", "\uff20")
"""Also in full width, which some spreadsheets read as the plain characters."""


def harmless(text: str) -> str:
    """The text with an apostrophe if a spreadsheet would execute it; numbers are unchanged.

    Source: OWASP, "CSV Injection".
    """
    if not text.startswith(_FORMULA):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text
