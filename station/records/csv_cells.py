"""Text in tables that spreadsheets open: none of it may be taken for a formula."""

from __future__ import annotations

_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def harmless(text: str) -> str:
    """With an apostrophe before what a spreadsheet would carry out; numbers stay as they are.

    Source: OWASP, "CSV Injection".
    """
    if not text.startswith(_FORMULA):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text
