"""Lists on the terminal: one line each, without ruled cells."""

from __future__ import annotations

from collections.abc import Sequence

from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table


def print_list(header: Sequence[str], rows: Sequence[Sequence[str]], nothing: str) -> None:
    """A table, or the sentence `nothing` where there are no rows."""
    console = Console(highlight=False)
    if not rows:
        console.print(nothing)
        return
    table = Table(*header, box=SIMPLE, padding=(0, 1, 0, 0))
    for row in rows:
        table.add_row(*row)
    console.print(table)
