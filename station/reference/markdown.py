"""Tables and headings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

MADE = "<!-- Made from the code by `make reference`; do not edit. -->\n"


def page(title: str, introduction: str, *parts: str) -> str:
    """A whole page."""
    return "\n".join([MADE, f"# {title}", introduction, *parts]).rstrip() + "\n"


def section(title: str, *parts: str, level: int = 2) -> str:
    """A heading and its content; empty parts are omitted."""
    return "\n".join(["", f"{'#' * level} {title}", *(part for part in parts if part)])


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; empty without rows."""
    lines = ["| " + " | ".join(_cell(cell) for cell in row) + " |" for row in rows]
    if not lines:
        return ""
    head = ["", "| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join([*head, *lines])


def code(text: str) -> str:
    """Text in code format."""
    return f"`{text}`"


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
