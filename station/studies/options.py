"""Options that the commands of several studies have."""

from __future__ import annotations

from pathlib import Path

import click

seed_option = click.option("--seed", type=click.IntRange(0), default=1, show_default=True)
workers_option = click.option(
    "--workers", type=click.IntRange(1), help="Processes; one for each core without it."
)
resume_option = click.option(
    "--resume", type=click.Path(file_okay=False, path_type=Path), help="Folder to go on from."
)
page_option = click.option("--out", type=click.Path(path_type=Path), help="Write the page here.")
