"""Options of several studies."""

from __future__ import annotations

from pathlib import Path

import click

seed_option = click.option(
    "--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of the random numbers."
)
workers_option = click.option(
    "--workers", type=click.IntRange(1), help="Number of processes.  [default: one for each core]"
)
resume_option = click.option(
    "--resume",
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder of intermediate results, from which the command continues.",
)
page_option = click.option("--out", type=click.Path(path_type=Path), help="File for the page.")
