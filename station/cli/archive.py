"""`station export`, `backup` and `verify`: copies of the history, and the check of its chain."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.progress import Progress

from station.cli.kept import config_option, kept
from station.records import LARGEST_ID, readings_to_csv
from station.settings import load_settings
from station.store import Store


@click.command("export")
@click.argument("calibration_id", metavar="[ID]", required=False, type=click.IntRange(1, LARGEST_ID))
@click.option(
    "--parquet",
    "folder",
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder to which the whole history is exported.",
)
@config_option
@click.pass_obj
def export_command(home: Path, calibration_id: int | None, folder: Path | None, config: Path | None) -> None:
    """Write the readings of a run as a measurement file to standard output, or the history as Parquet files.

    With --parquet, every finished run that is not yet in the folder is added to it.
    """
    if (calibration_id is None) == (folder is None):
        raise click.UsageError("Give the number of a run, or --parquet and a folder.")
    with kept(home, config) as store:
        if calibration_id is not None:
            uid = store.summary(calibration_id).uid
            click.echo(readings_to_csv(store.readings(calibration_id), run_uid=uid), nl=False)
        elif folder is not None:
            _export(store, folder, load_settings(config).name)


def _export(store: Store, folder: Path, station: str) -> None:
    from station.quality import export_parquet

    with Progress(console=Console(stderr=True), transient=True) as bar:
        runs = bar.add_task("Runs", total=None)
        found = export_parquet(store, folder, station, lambda count: bar.advance(runs, count))
    click.echo(
        f"{found.runs} runs, {found.readings} readings and {found.findings} rows of findings were added; the "
        f"folder holds runs up to {found.last}."
    )


@click.command("verify")
@click.option("--head", help="Hash printed by an earlier verify; it must be in the chain.")
@config_option
@click.pass_obj
def verify_command(home: Path, head: str | None, config: Path | None) -> None:
    """Check that no finished run was changed; the first changed run is named."""
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
    """Copy the whole history to a new FILE, also while the service runs."""
    with kept(home, config) as store:
        store.backup(file)
    click.echo(f"Backed up to {file}.")
