"""`station columns`: how a file from other software is understood, as a map to check and store."""

from __future__ import annotations

import json
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import file_path
from station.records import content_of, proposed_map, read_foreign

FIRST_ROWS = 3


@click.command("columns")
@click.argument("data", type=file_path)
@click.option("--no-header", is_flag=True, help="The file has no row with the names of the columns.")
@click.option("--sheet", default="", help="Sheet of a spreadsheet.  [default: the one with most numbers]")
def columns_command(data: Path, no_header: bool, sheet: str) -> None:
    """Propose a column map for a measurement file from other software.

    The map is printed: `station columns DATA > map.toml` stores it for `--columns map.toml`.
    """
    table = read_foreign(content_of(data), data.name, header=False if no_header else None, sheet=sheet)
    click.echo((f"sheet = {json.dumps(sheet)}\n" if sheet else "") + proposed_map(table), nl=False)
    first = table.rows[:FIRST_ROWS]
    lines = [f"row {line}" for line in table.lines[:FIRST_ROWS]]
    shown = Table("column", *lines, title=f"{data.name}: {len(table.rows)} rows, first as understood")
    for i, name in enumerate(table.header):
        shown.add_row(name, *(row[i] for row in first))
    Console(stderr=True, highlight=False).print(shown)
