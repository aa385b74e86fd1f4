"""`station import`: a measurement file into the history, diagnosed, while the service runs or not."""

from __future__ import annotations

import getpass
from contextlib import closing
from pathlib import Path

import click

from station.cli.files import content_of
from station.cli.kept import new_history
from station.five_bar import Robot
from station.records import CalibrationRequest, checked_name, checked_serial
from station.run_kinds import Upload, import_dataset
from station.settings import database_path, load_settings
from station.store import Store

_file = click.Path(path_type=Path)


@click.command("import")
@click.argument("data", type=_file)
@click.option("--confirm", "fresh_file", type=_file, help="Fresh readings to confirm the cause with.")
@click.option("--serial", default=Robot.default().serial, show_default=True, help="Robot that was measured.")
@click.option("--operator", default=getpass.getuser, help="Who imports; default: who is logged in.")
@click.option("--config", type=_file, help="Station file that names the database.")
@click.pass_context
def import_command(
    context: click.Context,
    data: Path,
    fresh_file: Path | None,
    serial: str,
    operator: str,
    config: Path | None,
) -> None:
    """Keep a measurement file as a finished run and trace what the model leaves over to its cause.

    Exit status 0: fresh readings confirm the model; 1: they do not, or there are none.
    """
    learned = _read(data)
    fresh = _read(fresh_file) if fresh_file else None
    request = CalibrationRequest(checked_serial(serial), "import", checked_name(operator))
    path = database_path(load_settings(config), context.obj)
    new = new_history(path)
    with closing(Store(path)) as store:
        run = store.summary(import_dataset(store, request, learned, fresh).id)
    if new:
        click.echo(new, err=True)
    click.echo(f"Run {run.id}: {run.verdict}. {run.reason}")
    context.exit(0 if run.verdict == "pass" else 1)


def _read(file: Path) -> Upload:
    return Upload(file.name, content_of(file))
