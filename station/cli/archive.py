"""`station export` and `station backup`: what was measured, taken elsewhere."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.kept import config_option, kept, run_argument
from station.records import readings_to_csv


@click.command("export")
@run_argument
@config_option
@click.pass_obj
def export_command(home: Path, calibration_id: int, config: Path | None) -> None:
    """One run's readings as a measurement file on standard output."""
    with kept(home, config) as store:
        click.echo(readings_to_csv(store.readings(calibration_id)), nl=False)


@click.command("backup")
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@config_option
@click.pass_obj
def backup_command(home: Path, file: Path, config: Path | None) -> None:
    """Copy the database to a new FILE, also while the service runs."""
    with kept(home, config) as store:
        store.backup(file)
    click.echo(f"Backed up to {file}.")
