"""`station confusion`: the diagnosis against random machines."""

from __future__ import annotations

from pathlib import Path

import click
from rich.progress import Progress

from station.cli.files import write_text
from station.studies.confusion import KINDS, markdown, run


@click.command("confusion")
@click.option("--machines", default=300, show_default=True, type=click.IntRange(1), help="Of each kind.")
@click.option("--seed", default=1, show_default=True, type=click.IntRange(0))
@click.option("--markdown", "out", type=click.Path(path_type=Path), help="Write the page here.")
def confusion_command(machines: int, seed: int, out: Path | None) -> None:
    """How often the diagnosis names the right cause, on random emulated machines."""
    with Progress() as progress:
        task = progress.add_task("machines", total=machines * len(KINDS))
        rows = run(machines, seed, lambda: progress.advance(task))
    text = markdown(rows, seed)
    if out:
        write_text(out, text)
    click.echo(text)
