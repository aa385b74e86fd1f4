"""`station real-robot`: the figures of docs/real-robot.md, from the logs of a real arm."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.files import file_path
from station.machines import read_robot
from station.serial_arm import Arm
from station.studies.real_robot import study, write


@click.command("real-robot")
@click.argument("logs", type=file_path, nargs=-1, required=True)
@click.option("--robot", "robot_file", type=file_path, required=True, help="Robot file of the arm.")
@click.option(
    "--folder",
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    required=True,
    help="Folder for the results.",
)
def real_robot_command(logs: tuple[Path, ...], robot_file: Path, folder: Path) -> None:
    """Diagnose logs of a real arm, apply the effects of the first log to the others, and write figures."""
    robot = read_robot(robot_file)
    if not isinstance(robot, Arm):
        raise click.UsageError(
            f'{robot_file} does not describe a serial arm; give a robot file with model = "serial-dh".'
        )
    result = study(robot, logs)
    try:
        page = write(result, folder)
    except OSError as error:
        raise click.UsageError(f"{folder} cannot be written to: {error.strerror}.") from error
    click.echo(page.read_text(encoding="utf-8"))
