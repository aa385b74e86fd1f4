"""`station refit`: stored readings, fitted again by the present identification and diagnosis."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from station.cli.files import check_folders, json_option, write_json
from station.cli.kept import config_option, kept
from station.records import LARGEST_ID
from station.settings import database_path, load_settings
from station.studies.engine import Engine
from station.studies.options import resume_option, workers_option
from station.studies.refit import Refitted, candidates, refit

MOST_SHOWN = 50


@click.command("refit")
@click.argument("ids", metavar="[ID]...", nargs=-1, type=click.IntRange(1, LARGEST_ID))
@click.option("--all", "everything", is_flag=True, help="Fit every finished calibration and diagnosis.")
@workers_option
@resume_option
@json_option("every change")
@config_option
@click.pass_obj
def refit_command(
    home: Path,
    ids: tuple[int, ...],
    everything: bool,
    workers: int | None,
    resume: Path | None,
    json_file: Path | None,
    config: Path | None,
) -> None:
    """Fit stored runs again with the present software and show the differences; nothing stored is changed."""
    check_folders(json_file)
    if bool(ids) == everything:
        raise click.UsageError("Name the runs, or give --all.")
    with kept(home, config) as store:
        runs = candidates(store, ids)
    path = database_path(load_settings(config), home)
    found = refit(path, runs, Engine(Console(stderr=True), workers, resume))
    if json_file:
        write_json(json_file, found)
    _show(found)


def _show(found: Refitted) -> None:
    console = Console(highlight=False)
    if found.changed:
        table = Table("run", "what", "reason")
        for change in found.changed[:MOST_SHOWN]:
            table.add_row(str(change.id), change.what, change.reason)
        console.print(table)
    hidden = len(found.changed) - MOST_SHOWN
    if hidden > 0:
        console.print(f"{hidden} more changes are in the file of --json only.")
    changing = len({change.id for change in found.changed})
    console.print(
        f"{found.runs} runs fitted again in {found.seconds:.1f} s; {changing} would change."
        + (f" {found.left_out} runs cannot be fitted again." if found.left_out else "")
    )
