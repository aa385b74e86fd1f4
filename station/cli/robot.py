"""`station robot`: the robot file of an arm from the description that other software uses."""

from __future__ import annotations

from pathlib import Path

import click

from station.cli.files import file_path
from station.records import content_of, sections_to_toml
from station.serial_arm import arm_from_urdf


@click.command("robot")
@click.option("--urdf", required=True, type=file_path, help="URDF file of the arm.")
@click.option("--base", required=True, help="Name of the fixed link.")
@click.option("--tool", required=True, help="Name of the link whose origin is measured.")
@click.option("--serial", help="Serial number of the robot.  [default: the name of the file]")
def robot_command(urdf: Path, base: str, tool: str, serial: str | None) -> None:
    """Write the robot file of an arm from its URDF description: `station robot ... > robot.toml`."""
    arm = arm_from_urdf(content_of(urdf), str(urdf), base, tool, serial or urdf.stem)
    click.echo(sections_to_toml(arm.to_json()), nl=False)
