"""`station export`, `backup` and `verify`: what was measured, taken elsewhere, and whether it is whole."""

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
        uid = store.summary(calibration_id).uid
        click.echo(readings_to_csv(store.readings(calibration_id), run_uid=uid), nl=False)


@click.command("verify")
@click.option("--head", help="Hash that an earlier verify printed; it must be in the chain.")
@config_option
@click.pass_obj
def verify_command(home: Path, head: str | None, config: Path | None) -> None:
    """Whether every finished run is as it ended; names the first that is not."""
    with kept(home, config) as store:
        found = store.verify()
        known = head is None or store.in_chain(head)
    if found.older:
        click.echo(f"{found.older} runs are older than the chain and not covered.")
    if found.broken is not None:
        click.echo(f"Run {found.broken.id}, uid {found.broken.uid}: {found.broken.why}.")
        raise SystemExit(1)
    if not known:
        click.echo(f"No run has the hash {head}: runs were removed, or the chain was made again.")
        raise SystemExit(1)
    click.echo(f"{found.runs} runs are as they ended. Head of the chain: {found.head or 'none'}")


@click.command("backup")
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@config_option
@click.pass_obj
def backup_command(home: Path, file: Path, config: Path | None) -> None:
    """Copy the database to a new FILE, also while the service runs."""
    with kept(home, config) as store:
        store.backup(file)
    click.echo(f"Backed up to {file}.")
