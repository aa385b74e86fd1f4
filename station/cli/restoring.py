"""`station restore`: the history replaced by a backup."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import click

from station.cli.kept import at_terminal, config_option
from station.service import holding
from station.settings import database_path, load_settings
from station.store import Store, restore


@click.command("restore")
@click.argument("file", type=click.Path(dir_okay=False, exists=True, path_type=Path))
@config_option
@click.pass_obj
def restore_command(home: Path, file: Path, config: Path | None) -> None:
    """Replace the history by the backup FILE; the service must not run, and the previous history is kept."""
    path = database_path(load_settings(config), home)
    with holding(home):
        aside = restore(file, path)
        with closing(Store(path)) as store:
            store.record(at_terminal(), "history.restored", f"backup {file.name}")
            interrupted = store.interrupt_unfinished()
            newest = store.last_on_rig()
    if aside is not None:
        click.echo(f"The previous history is kept at {aside}.")
    for run in interrupted:
        click.echo(f"Run {run} was active at the time of the backup; it is now interrupted.")
    click.echo(f"Restored {path}; " + (f"its newest run is {newest.id}." if newest else "it has no runs."))
