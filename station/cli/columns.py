"""`station columns`: how a file made elsewhere is understood, as a map to check and keep."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import content_of
from station.records import proposed_map, read_foreign

FIRST_ROWS = 3
WIDEST = 12
"""Columns shown; a wider table cannot be read in a terminal."""


@click.command("columns")
@click.argument("data", type=click.Path(path_type=Path))
@click.option("--no-header", is_flag=True, help="The first row is a row of numbers already.")
def columns_command(data: Path, no_header: bool) -> None:
    """Propose a column map for a file of measurements made elsewhere.

    The map is printed to be kept: `station columns DATA > map.toml`, then `--columns map.toml`.
    """
    table = read_foreign(content_of(data), data.name, header=not no_header)
    proposal = proposed_map(table)
    click.echo(("header = false\n" if no_header else "") + proposal, nl=False)
    shown = Table(*table.header[:WIDEST], title=f"{data.name}: {len(table.rows)} rows, first as understood")
    for row in table.rows[:FIRST_ROWS]:
        shown.add_row(*row[:WIDEST])
    Console(stderr=True, highlight=False).print(shown)
